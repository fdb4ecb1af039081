# bash completion of slamot, which tells itself what may stand at the cursor.

# The words after the program's name up to the cursor, as they were typed: bash takes some of their
# characters for ends of words.
_slamot_words()
{
  local word last=
  words=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ ${#words[@]} -gt 0 && ($word == [=:] || ($last == [=:] && -n $word)) ]]; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
    last=$word
  done
}

_slamot()
{
  local words word what current before value
  _slamot_words
  current=${words[-1]}
  words=("${words[@]/#\~\//$HOME/}")
  before=${current%"${current##*[=:]}"}  # what bash leaves as it is
  value=$current
  [[ $current == --*=* ]] && value=${current#*=}
  COMPREPLY=()
  while IFS=$'\t' read -r word what; do
    case $word in
      :files)
        compopt -o filenames 2>/dev/null
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X "!$what" -- "$value"; compgen -d -- "$value") ;;
      :folders)
        compopt -o filenames 2>/dev/null
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$value") ;;
      *=) compopt -o nospace 2>/dev/null
        COMPREPLY+=("${word#"$before"}") ;;
      *) COMPREPLY+=("${word#"$before"}") ;;
    esac
  done < <("${COMP_WORDS[0]/#\~\//$HOME/}" __complete - "${words[@]}" 2>/dev/null)
}
complete -F _slamot slamot
