#!/usr/bin/env bash
# The robots of MRCLAM dataset 6 but one as a team that tracks the one; landmarks seen by all, or
# hidden from two.  Prints a table in Markdown.
#   bench/mrclam-team.sh DATASET6 [OUT]     (slamot-out/mrclam-team)
set -euo pipefail
[ $# -ge 1 ] || { echo "mrclam-team.sh: skipped: it needs the folder of MRCLAM dataset 6 as its argument"; exit 0; }
data=$(readlink -f "$1") out=${2:-slamot-out/mrclam-team}
cd "$(dirname "$0")/.."
slamot=${SLAMOT:-build/apps/slamot/slamot} target=3
mkdir -p "$out"
"$slamot" import mrclam "$data" --team --target $target --odometry-delay 0.22 -q -o "$out/seen.rawlog"
"$slamot" import mrclam "$data" --team --target $target --odometry-delay 0.22 --hide-landmarks 4,5 -q -o "$out/hidden.rawlog"

# run LOGS NAME [OPTIONS]: one row of the table; errors in m, NEES by degree of freedom
run()
{
  local logs=$1 name=$2 folder; shift 2
  folder="$out/$logs-$(tr -c 'a-z\n' - <<<"$name")"
  "$slamot" team config-ini/team-mrclam.ini "$out/$logs".robot{1,2,4,5}.rawlog -q -o "$folder" "$@"
  python3 - "$folder/team.json" "$name" <<'PY'
import json, sys
team = json.load(open(sys.argv[1]))
def cell(e): return '%.2f (%.1f)' % (e['position_mean_error_m'], e['nees_mean'] / 3)
wrong = sum((r['messages'] or {}).get('wrong_candidates_fused') or 0 for r in team['robots'])
print('| %s | %s | %s | %d |' % (sys.argv[2], ' | '.join(cell(r['robot']) for r in team['robots']),
                                ' | '.join(cell(r['target']) for r in team['robots']), wrong))
PY
}
for logs in seen hidden; do
  case $logs in
    seen) printf '\nAll robots see landmarks.\n' ;;
    hidden) printf '\nRobots 4 and 5 see only team mates and the target.\n' ;;
  esac
  printf '\n| rule | robot 1 | robot 2 | robot 4 | robot 5 | target by 1 | by 2 | by 4 | by 5 | wrong |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n'
  run $logs "no exchange" --set team.rule=none
  run $logs "ci, mates identified" --set team.rule=ci
  run $logs "ci, mates alike" --set team.rule=ci --set team.mate_identities=false
  run $logs "split-ci, mates identified" --set team.rule=split-ci
  run $logs "ici, mates identified" --set team.rule=ici
  run $logs "paper, mates identified" --set team.rule=paper
  run $logs "centralized, mates identified" --set team.rule=centralized
done
