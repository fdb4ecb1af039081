#!/bin/sh
# usage: example.sh SLAMOT BUILD_MAP SOURCE_DIR FOLDER
set -eu
config=$3/config-ini/rbpf-slamot.experiment1.ini log=$3/share/datasets/experiment1.rawlog
cd "$4"
rm -rf result built*
"$1" run -q "$config" "$log" -o result
"$2" "$config" "$log" built
# slamot run has a row for the start.
tail -n +2 result/robot.tum | cut -d' ' -f1-3 > built.expected
cut -d' ' -f1-3 built.tum | awk '{ getline line < "built.expected"; split(line, e)
  for (i = 1; i <= 3; ++i) if (($i - e[i]) ^ 2 > 1e-14) { print "line " NR ": " $0 ", not " line; exit 1 } }
  END { if (NR != 320) { print NR " lines"; exit 1 } }'
for file in built.simplemap built.png; do [ -s "$file" ] || { echo "no $file"; exit 1; }; done
[ "$(cat built*landmarks*.csv | wc -l)" = 21 ] || { echo "not 20 landmarks"; exit 1; }
