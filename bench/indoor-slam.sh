#!/usr/bin/env bash
# MRPT's icp-slam and rbpf-slam beside slamot on indoor logs of a laser and odometry: errors of relations, how sharp a map
# the scans make along each path (mean map entropy), and the time of whole processes.  Prints a table in Markdown.
# usage: bench/indoor-slam.sh [NAME=LOG[,RELATIONS]...]    logs of CARMEN, as intel=intel.log.gz,intel.relations.gz
# The SENA log of Debian's mrpt-common is always taken.  ./dev bench builds what it needs; of Debian: mrpt-apps, mrpt-common.
# SEEDS (3) runs of what draws random numbers; with ONLY=REGEX nothing but the methods it matches.  Results stay in
# slamot-out/indoor-slam, grids as PNG with them; a rerun does only what is missing.
set -euo pipefail
from=$PWD
cd "$(dirname "$(readlink -f "$0")")/.."
export LC_ALL=C
build=${SLAMOT_BUILD:-build} seeds=${SEEDS:-3} only=${ONLY:-.}
slamot=$build/apps/slamot/slamot files=$build/bench/indoor-slam-files out=slamot-out/indoor-slam
sena='/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog'
# Deviations of odometry for rbpf-slam: m/m, m/rad, rad/m, rad/rad, m, rad; over a step of 0.55 m and 0.5 rad what slamot's
# importer has (doc/importing.md).
noise=(0.1 0.05 0.1 0.14 0.01 0.005)

die() { printf 'indoor-slam.sh: error: %s\n' "$*" >&2; exit 1; }
command -v icp-slam >/dev/null && command -v rbpf-slam >/dev/null && [ -r "$sena" ] ||
  { echo "indoor-slam.sh: skipped: MRPT's programs or its logs are missing: apt-get install mrpt-apps mrpt-common"; exit 0; }
[ -x "$slamot" ] && [ -x "$files" ] || die "$slamot or $files is missing: run ./dev bench"
slamot=$(readlink -f "$slamot")
[[ $seeds =~ ^[1-9][0-9]*$ ]] || die "SEEDS '$seeds' is no number of seeds: give one from 1 on"

timed()  # FOLDER COMMAND...: its time to FOLDER.time, as `wall cpu`
{
  local folder=$1 TIMEFORMAT='%R %U %S' times; shift
  times=$({ time "$@" 2>&3; } 3>&2 2>&1 >/dev/null)
  awk '{ print $1, $2 + $3 }' <<<"$times" >"$folder.time"
}

# theirs PROGRAM CONFIG LOG NAME PATH [KEY=VALUE...]: to the folder LOG-NAME, and its PATH as LOG-NAME.tum.  These programs
# wait for a key after an error.
theirs()
{
  local program=$1 config=$2 log=$3 name=$3-$4 path=$5 key; shift 5
  cp "bench/indoor-slam/$config" "$out/$name.ini"
  for key in "logOutput_dir=$out/$name" "$@"; do
    sed -i "s|^${key%%=*} *=.*|${key%%=*} = ${key#*=}|" "$out/$name.ini"
  done
  printf 'running %s\n' "$name" >&2
  timed "$out/$name" quietly "$out/$name.txt" timeout 7200 "$program" "$out/$name.ini" "$out/$log.mrpt.rawlog"
  awk -f bench/indoor-slam/tum.awk "$out/$log-dead-reckoning/robot.tum" "$out/$name/$path" >"$out/$name.part" ||
    die "$program failed: see $out/$name.txt"
  mv "$out/$name.part" "$out/$name.tum"
}
quietly() { local text=$1; shift; "$@" </dev/null >"$text" 2>&1 || true; }

# ours LOG NAME: the path as believed at each step as LOG-NAME-steps.tum, and as believed in the end as LOG-NAME.tum.
ours()
{
  local folder=$out/$1-$2 path
  printf 'running %s\n' "$(basename "$folder")" >&2
  timed "$folder" "$slamot" run "config-ini/$2.ini" "$out/$1.rawlog" -q -o "$folder"
  path=$folder/path/robot.tum
  [ -r "$path" ] || path=$folder/robot.tum
  cp "$folder.time" "$folder-steps.time"
  cp "$folder/robot.tum" "$folder-steps.tum"
  cp "$path" "$folder.tum"
}

# wanted LOG NAME: whether a method is asked for and has not been run.
wanted() { [[ $2 =~ $only ]] && [ ! -r "$out/$1-$2.tum" ]; }

number() { sed -n "s/^ *\"$1\": \([^,]*\),\{0,1\}$/\1/p" "$out/evaluation.json" | head -n 1; }

# row LOG LABEL NAME...: means over results.
row()
{
  local log=$1 label=$2 name; shift 2
  for name in "$@"; do
    [ -r "$out/$log-$name.tum" ] || continue
    "$slamot" evaluate "$out/$log-$name.tum" --scans "$out/$log.rawlog" --json >"$out/evaluation.json"
    printf '%s %s %s %s\n' "$(number translation_mean_error_m)" "$(number rotation_mean_error_rad)" \
      "$(number mean_map_entropy)" "$(cat "$out/$log-$name.time")"
  done | awk -v log_name="$log" -v label="$label" '
    { if (NF == 3) { for (i = 5; i > 2; i--) $i = $(i - 2); $1 = $2 = "-" }
      m = $1 == "-" ? "-" : 1
      for (i = 1; i <= 5; i++) { s[i] += $i; if (NR == 1 || $i < lo[i]) lo[i] = $i; if (NR == 1 || $i > hi[i]) hi[i] = $i } }
    function cell(i, f, k) { return sprintf(f, k * s[i] / NR) (NR > 1 ? sprintf(" (" f " to " f ")", k * lo[i], k * hi[i]) : "") }
    END { if (NR) printf "| %s | %s | %s | %s | %s | %s | %s |\n", log_name, label, m == "-" ? "" : cell(1, "%.3f", 1),
          m == "-" ? "" : cell(2, "%.2f", 57.29578), cell(3, "%.3f", 1), cell(5, "%.1f", 1), cell(4, "%.1f", 1) }'
}

run_all()  # LOG
{
  local log=$1 seed
  [ -r "$out/$log-dead-reckoning.tum" ] || ours "$log" dead-reckoning  # the others need its times
  wanted "$log" scan-slam && ours "$log" scan-slam  # no chance in it
  wanted "$log" icp-slam-points && theirs icp-slam icp-slam.ini "$log" icp-slam-points log_estimated_path.txt
  wanted "$log" icp-slam-grid &&
    theirs icp-slam icp-slam.ini "$log" icp-slam-grid log_estimated_path.txt matchAgainstTheGrid=1
  for ((seed = 1; seed <= seeds; seed++)); do
    wanted "$log" rbpf-slam-icp-$seed &&
      theirs rbpf-slam rbpf-slam.ini "$log" rbpf-slam-icp-$seed most_likely_path.txt RANDOM_SEED=$seed
    wanted "$log" rbpf-slam-sampling-$seed && theirs rbpf-slam rbpf-slam.ini "$log" rbpf-slam-sampling-$seed \
      most_likely_path.txt RANDOM_SEED=$seed PF_algorithm=3
  done
  return 0
}

print_all()  # LOG
{
  local log=$1
  row "$log" 'dead-reckoning' dead-reckoning
  row "$log" 'scan-slam, step by step' scan-slam-steps
  row "$log" 'scan-slam, path in the end' scan-slam
  row "$log" '`icp-slam`, point map' icp-slam-points
  row "$log" '`icp-slam`, grid map' icp-slam-grid
  row "$log" '`rbpf-slam`, ICP' $(eval "echo rbpf-slam-icp-{1..$seeds}")
  row "$log" '`rbpf-slam`, sampling' $(eval "echo rbpf-slam-sampling-{1..$seeds}")
}

mkdir -p $out
logs=()
for log in "$@"; do
  [[ $log =~ ^([a-z0-9]+)=([^,]+)(,(.+))?$ ]] || die "'$log' is no log: give NAME=LOG or NAME=LOG,RELATIONS"
  name=${BASH_REMATCH[1]} source=${BASH_REMATCH[2]} relations=${BASH_REMATCH[4]}
  logs+=("$name")
  (cd "$from" && readlink -e "$source" >/dev/null) || die "$source is not there"
  [ -r $out/"$name".rawlog ] || (
    here=$PWD && cd "$from" &&
      "$slamot" import carmen "$source" ${relations:+--relations "$relations"} -q -o "$here/$out/$name.rawlog")
  [ -r $out/"$name".mrpt.rawlog ] || "$files" noise $out/"$name".rawlog $out/"$name".mrpt.rawlog "${noise[@]}"
done
[[ " ${logs[*]} " != *" sena "* ]] || die "sena is the name of MRPT's own log: give the other one another name"
logs+=(sena)
ln -sf "$sena" $out/sena.rawlog
ln -sf "$sena" $out/sena.mrpt.rawlog
for log in "${logs[@]}"; do run_all "$log"; done
table=$(for log in "${logs[@]}"; do print_all "$log"; done)
printf '\n| log | method | relations: distance [m] | angle [deg] | mean map entropy | CPU [s] | wall [s] |\n'
printf '| --- | --- | --- | --- | --- | --- | --- |\n'
printf '%s\n' "$table"
