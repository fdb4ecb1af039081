# fish completion of slamot, which tells itself what may stand at the cursor.

function __slamot_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    for line in ($words[1] __complete - $words[2..] "$current" 2>/dev/null)
        set -l parts (string split -m 1 \t -- $line)
        switch $parts[1]
            case :files
                __fish_complete_suffix (string replace '*' '' -- $parts[2])
            case :folders
                __fish_complete_directories "$current"
            case '*'
                echo $line
        end
    end
end
complete -c slamot -f -a '(__slamot_complete)'
