#!/bin/sh
# The files and commands of doc/first-filter.md, as they stand, in a folder of their own.
# usage: first-filter.sh SOURCE_DIR HOME_DIR, where HOME_DIR/slamot has the installed package
set -eu
export HOME="$2"
folder=$HOME/scaled-odometry
rm -rf "$folder"
mkdir -p "$folder"
awk -v OUT="$folder" -f "$1/tests/package/extract.awk" "$1/doc/first-filter.md"
for file in CMakeLists.txt ScaledOdometry.h ScaledOdometry.cpp ScaledOdometry_test.cpp scaled-odometry.ini \
  commands.sh; do
  [ -s "$folder/$file" ] || { echo "doc/first-filter.md: no block for $file" >&2; exit 1; }
done
cd "$folder"
sh -eux commands.sh
for file in summary.json robot.tum report.html; do
  [ -s "result/$file" ] || { echo "slamot run left no $file" >&2; exit 1; }
done
grep -q '"method": "scaled-odometry"' result/summary.json
