#!/usr/bin/env bash
# What kf-slam logged, as a result folder that `slamot evaluate` reads.
# usage: result.sh LOG_DIR MEANS LIKE OUT [known]
#   LOG_DIR  with SAVE_LOG_FREQUENCY = 1
#   MEANS    of the last map: see kf-slam-files
#   LIKE     a result of `slamot run` on the same frames, for times and identities
#   known    kf-slam was given the landmarks' identities
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
log=$1 means=$2 like=$3 out=$4
export LC_ALL=C
mkdir -p "$out"
files=()
for pose in "$log"/robot_pose_*.txt; do
  last=${pose/robot_pose/full_cov}
  files+=("$pose" "$last")
done
awk -f "$here/robot.awk" "$like/robot.csv" "${files[@]}" >"$out/robot.csv"
awk -v names="$out/names" -v known="${5:+1}" -f "$here/pairings.awk" \
  "$like/pairings.csv" "$log/data_association.log" >"$out/pairings.csv"
awk -f "$here/map.awk" "$out/names" "$last" "$means" >"$out/landmarks.csv"
cat >"$out/summary.json" <<TEXT
{"dataset": "", "complete": true, "observations": $(($(wc -l <"$out/pairings.csv") - 1)),
 "landmarks": {"mapped": $(wc -l <"$out/names")}, "particles": {"count": null}}
TEXT
rm "$out/names"
