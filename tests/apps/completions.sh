#!/usr/bin/env bash
# What shells make of what the program proposes.  usage: completions.sh SOURCE_DIR SLAMOT FOLDER
set -euo pipefail
completions=$1/share/completions slamot=$2 config=$1/config-ini/rbpf-slamot.experiment1.ini
rm -rf "$3"
mkdir -p "$3/my logs" "$3/bin"
cd "$3"
ln -s "$slamot" bin/slamot
PATH=$PWD/bin:$PATH
touch a.ini b.rawlog "my logs/c.rawlog"

failed=0
expect()  # WHAT IS EXPECTED
{
  [ "$2" = "$3" ] || { printf '%s: "%s", not "%s"\n' "$1" "$2" "$3"; failed=1; }
}

# Words as bash cuts them: at = and : too.
in_bash()
{
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _slamot
  printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' '
}
. "$completions/slamot.bash"
expect "bash: a command" "$(in_bash slamot si)" simulate
expect "bash: an option" "$(in_bash slamot run --sal)" --salvage
expect "bash: files, and folders on the way to them" "$(in_bash slamot run '')" "a.ini bin my logs"
expect "bash: folders" "$(in_bash slamot run -o m)" "my logs"
expect "bash: a value after =" "$(in_bash slamot run --align = r)" rigid
expect "bash: all values after =" "$(in_bash slamot run --align =)" "first-pose none rigid"
expect "bash: a file after =" "$(in_bash slamot run --plugin=a --output = m)" "my logs"
expect "bash: a setting's key" "$(in_bash slamot run "$config" --set rbpf-slamot.partic)" rbpf-slamot.particles=
expect "bash: a setting's value" "$(in_bash slamot run "$config" --set rbpf-slamot.association = jc)" jcbb
expect "bash: after a setting" "$(in_bash slamot run a.ini --set a.b = c '')" "b.rawlog bin my logs"

if command -v fish >/dev/null; then
  in_fish() { HOME=$PWD fish --no-config -c "source $completions/slamot.fish; complete -C '$1'" | cut -f 1 | sort | paste -sd ' '; }
  expect "fish: a command" "$(in_fish 'slamot si')" simulate
  expect "fish: an option" "$(in_fish 'slamot run --sal')" --salvage
  expect "fish: a value" "$(in_fish 'slamot run --align r')" rigid
  expect "fish: a setting" "$(in_fish "slamot run $config --set rbpf-slamot.association=jc")" rbpf-slamot.association=jcbb
  expect "fish: files" "$(in_fish 'slamot run a')" a.ini
fi

if command -v zsh >/dev/null; then
  # zsh's own functions need a terminal: here they print what they are given.
  in_zsh()
  {
    zsh -f -c '
      _files() { print -r -- "files $*" }
      _describe() { print -r -- "${(@P)2}" "${@[3,-1]}" }
      complete_it() { source $1; }
      words=("${@[2,-1]}") CURRENT=$#words PREFIX=$words[-1]
      complete_it $1' zsh "$completions/_slamot" "$@" | paste -sd ' '
  }
  expect "zsh: a command" "$(in_zsh slamot info | cut -d : -f 1)" info
  expect "zsh: files" "$(in_zsh slamot run '')" "files -g *.ini"
  expect "zsh: folders" "$(in_zsh slamot run -o '')" "files -/"
  expect "zsh: a setting" "$(in_zsh slamot run "$config" --set rbpf-slamot.partic)" "rbpf-slamot.particles=:200 -S "
  expect "zsh: a value" "$(in_zsh slamot run --align r)" rigid
fi
exit $failed
