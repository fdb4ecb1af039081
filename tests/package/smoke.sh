#!/bin/sh
# What the packages must do where they are all installed, and nothing else of slamot is.
# usage: smoke.sh FOLDER    FOLDER is made, to work in
set -eu
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$1"
mkdir -p "$1"
cd "$1"
share=/usr/share/slamot
step() { printf '== %s\n' "$*"; }
fail() { printf 'smoke.sh: error: %s\n' "$*" >&2; exit 1; }
# holds TEXT COMMAND...: what it prints has the text
holds()
{
  text=$1; shift
  "$@" >printed 2>&1 || { cat printed; fail "$*"; }
  grep -q -- "$text" printed || { cat printed; fail "$* does not print $text"; }
}

step "the program, on what is shipped"
holds '^[0-9]*\.[0-9]*\.[0-9]*$' slamot --version
slamot run "$share/config-ini/rbpf-slamot.post-field.ini" "$share/datasets/post-field.rawlog" -o result --threads 2
for file in summary.json robot.tum report.html scene.3Dscene; do
  [ -s "result/$file" ] || fail "slamot run left no $file"
done
grep -q '<svg' result/report.html || fail "report.html has no plots"
slamot render result -o picture.png --width 320 --height 240
holds PNG head -c 8 picture.png
slamot render result -o film.mp4 --width 128 --height 96 --fps 2 --speed 60
holds ftyp head -c 12 film.mp4

step "manual pages, and the example of one as it stands"
for page in slamot slamot-run slamot-study; do holds 'EXIT STATUS' env MANWIDTH=80 man -P cat "$page"; done
command=$(env MANWIDTH=200 man -P cat slamot-simulate | sed -n 's/^ *\(slamot simulate .*\)/\1/p' | tail -n 1)
holds . sh -c "$command"
[ -s experiment1.rawlog ] || fail "$command"

step "completion"
holds simulate bash -c '. /usr/share/bash-completion/completions/slamot
  COMP_WORDS=(slamot si) COMP_CWORD=1; _slamot; printf "%s\n" "${COMPREPLY[@]}"'

step "the documentation"
for page in index gallery api/index; do
  [ -s "/usr/share/doc/slamot-doc/html/$page.html" ] || fail "slamot-doc has no html/$page.html"
done

step "MRPT's tools know its classes"
holds 'BLOBS */ *1200 ' rawlog-edit -p libslamot-mrpt.so -i "$share/datasets/post-field.rawlog" --info
for tool in RawLogViewer SceneViewer3D; do
  grep -q "^Exec=$tool -l libslamot-mrpt.so" /usr/share/applications/slamot-*.desktop || fail "no menu entry of $tool"
done

step "a filter of one's own"
mkdir source home
ln -s /usr/share/doc/slamot-doc/doc source/doc
ln -s "$here/../../tests" source/tests
ln -s /usr home/slamot
CMAKE_GENERATOR=Ninja sh "$here/first-filter.sh" "$PWD/source" "$PWD/home" >filter.log 2>&1 ||
  { tail -n 30 filter.log; fail "the manual's first filter"; }
echo "smoke.sh: all is well"
