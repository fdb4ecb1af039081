#!/usr/bin/env bash
# The figures of doc/real-data.md on MRCLAM: imports each robot's log, with identities and without, and runs the studies.
# usage: bench/mrclam.sh DATASET [SEEDS]    the folder of MRCLAM dataset 6; default 10 seeds; ./dev build first
# Results stay in slamot-out/mrclam; a rerun does only what is missing.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
die() { printf 'mrclam.sh: error: %s\n' "$*" >&2; exit 1; }
[ $# -gt 0 ] || { echo "mrclam.sh: skipped: it needs the folder of MRCLAM dataset 6 as its argument"; exit 0; }
slamot=${SLAMOT_BUILD:-build}/apps/slamot/slamot out=slamot-out/mrclam
[ -d "$1" ] || die "'$1' is no folder: give that of MRCLAM dataset 6"
[ -x "$slamot" ] || die "$slamot is missing: run ./dev build"
wheels=(--odometry-delay 0.22 --std-heading 0.3 --std-heading-turning 0.12)  # see doc/importing.md
mkdir -p $out
for robot in 1 2 3 4 5; do
  "$slamot" import mrclam "$1" --robot $robot "${wheels[@]}" -q -o $out/robot$robot.rawlog
  "$slamot" import mrclam "$1" --robot $robot "${wheels[@]}" -q -o $out/unlabelled$robot.rawlog \
    --no-landmark-ids --no-target-ids
done
for name in mrclam mrclam-unlabelled; do
  for align in rigid none; do
    "$slamot" study config-ini/study.rbpf-slamot.$name.ini --set study.align=$align --set study.seeds="${2:-10}" \
      -o $out/$name-$align
  done
done
