#!/bin/sh
# The example of doc/mrpt-tools.md against the installed package, whose program finds its modules.
# usage: map-builder.sh SOURCE_DIR HOME_DIR, where HOME_DIR/slamot has the installed package
set -eu
folder=$2/map-builder share=$2/slamot/share/slamot
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cmake -S "$1/doc/examples/map-builder" -B build -DCMAKE_PREFIX_PATH="$2/slamot"
cmake --build build
config=$share/config-ini/rbpf-slamot.experiment1.ini log=$share/datasets/experiment1.rawlog
build/build-map "$config" "$log" built
[ "$(wc -l <built.tum)" = 320 ] || { echo "no path" >&2; exit 1; }
"$2/slamot/bin/slamot" run -q "$config" "$log" -o result
"$2/slamot/bin/slamot" render result -o film.mp4 --width 128 --height 96 --fps 5 --speed 4
[ -s film.mp4 ] || { echo "no film" >&2; exit 1; }
