#!/usr/bin/env bash
# MRPT's kf-slam beside slamot with 200 particles on MRPT's own demo log: time of whole processes, and accuracy.
# usage: bench/kf-slam.sh [ROUNDS]    default 7; ./dev bench builds what it needs; of Debian: mrpt-apps, mrpt-common
# A round runs every program once, in turn, so that all meet the same load; slamot's seed is the round's number.
# Results stay in slamot-out/kf-slam, the log with its truth as slamot takes it too.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
export LC_ALL=C
rounds=${1:-7}
build=${SLAMOT_BUILD:-build}
slamot=$build/apps/slamot/slamot files=$build/bench/kf-slam-files
data=/usr/share/mrpt/datasets/kf-slam_demo
shipped=/usr/share/mrpt/config_files/kf-slam/EKF-SLAM_test_2d.ini
out=slamot-out/kf-slam log=slamot-out/kf-slam/kf-slam_demo

die() { printf 'kf-slam.sh: error: %s\n' "$*" >&2; exit 1; }
command -v kf-slam >/dev/null && [ -r $data.rawlog ] && [ -r $shipped ] ||
  die "MRPT's kf-slam or its demo is missing: apt-get install mrpt-apps mrpt-common"
[ -x "$slamot" ] && [ -x "$files" ] || die "$slamot or $files is missing: run ./dev bench"
[[ $rounds =~ ^[1-9][0-9]*$ ]] || die "'$rounds' is no number of rounds: give one from 1 on"

slamot_run()  # SEED NAME [OPTIONS]
{
  "$slamot" run config-ini/rbpf-slamot.kf-slam-demo.ini $data.rawlog -q --seed "$1" -o "$out/$2" "${@:3}"
}

# kf_slam NAME LOG [KEY=VALUE...]: as shipped but for these keys, without a window, to the folder NAME. It says little
# with its exit status, and waits for a key after an error.
kf_slam()
{
  local name=$1 rawlog=$2 key; shift 2
  cp $shipped "$out/$name.ini"
  for key in SHOW_3D_LIVE=false "logOutput_dir=$out/$name" "$@"; do
    sed -i "/^${key%%=*}[ =]/d; /^\[MappingApplication\]/a $key" "$out/$name.ini"
  done
  timeout 600 kf-slam "$out/$name.ini" "$rawlog" </dev/null >"$out/$name.txt" 2>&1 || true
  grep -q 'KF-SLAM finished' "$out/$name.txt" || die "kf-slam failed: see $out/$name.txt"
}
least=(SAVE_LOG_FREQUENCY=1000000 SAVE_3D_SCENES=false SAVE_MAP_REPRESENTATIONS=false SAVE_DA_LOG=false)

timed()  # NAME COMMAND...: adds a line `wall cpu` to NAME.times
{
  local name=$1 TIMEFORMAT='%R %U %S'; shift
  { time "$@" 2>&3; } 3>&2 2>"$out/time"
  awk '{ print $1, $2 + $3 }' "$out/time" >>"$out/$name.times"
}

time_all()
{
  local round
  for ((round = 1; round <= rounds; round++)); do
    timed ours slamot_run $round known-$round
    timed theirs kf_slam kf-known $data.rawlog
    timed theirs-least kf_slam kf-least $data.rawlog "${least[@]}"
    timed ours-nn slamot_run $round nn-$round --set rbpf-slamot.association=nn
    timed theirs-nn kf_slam kf-nn $log.noid.rawlog
  done
}

# Median, least and greatest of the numbers in standard input.
spread()
{
  sort -g | awk '{ v[NR] = $1 }
                 END { printf "%.2f (%.2f to %.2f)", (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2, v[1], v[NR] }'
}

times()  # NAME LABEL
{
  printf '%-42s %-22s %s\n' "$2" "$(cut -d' ' -f1 "$out/$1.times" | spread)" "$(cut -d' ' -f2 "$out/$1.times" | spread)"
}

ratio()  # OURS THEIRS LABEL
{
  local both; both=$(paste -d' ' "$out/$1.times" "$out/$2.times")
  printf '%-42s %-22s %s\n' "$3" "$(awk '{ print $1 / $3 }' <<<"$both" | spread)" "$(awk '{ print $2 / $4 }' <<<"$both" | spread)"
}

print_times()
{
  printf '\n%-42s %-22s %s\n' "median (least to greatest) of $rounds rounds" 'wall [s]' 'CPU [s]'
  times ours 'slamot'
  times theirs 'kf-slam, as shipped, without its window'
  times theirs-least 'kf-slam, writing as little as it can'
  times ours-nn 'slamot, no identities'
  times theirs-nn 'kf-slam, no identities'
  ratio ours theirs 'slamot / kf-slam'
  ratio ours theirs-least 'slamot / kf-slam that writes little'
  ratio ours-nn theirs-nn 'slamot / kf-slam, no identities'
}

# X.truth beside the log, by the times of a run.
make_truth()
{
  ln -sf $data.rawlog $log.rawlog
  mkdir -p $log.truth
  awk -f bench/kf-slam/path.awk "$out/known-1/robot.tum" ${data}_ground_truth_robot_path.txt >$log.truth/robot.tum
  awk 'BEGIN { print "id,x,y" } NF == 7 { print $7 "," $1 "," $2 }' ${data}_ground_truth.txt >$log.truth/landmarks.csv
}

# kf_result NAME LOG [known]: a run that logs each step, one that saves its last map, and a result folder of both.
kf_result()
{
  local last
  kf_slam each "$2" SAVE_LOG_FREQUENCY=1 SAVE_3D_SCENES=false SAVE_MAP_REPRESENTATIONS=false
  last=$(($(find "$out/each" -name 'robot_pose_*' | wc -l) - 1))
  kf_slam last "$2" SAVE_LOG_FREQUENCY=$last
  "$files" map "$out/last/kf_state_$(printf %05d $last).3Dscene" >"$out/means"
  bench/kf-slam/result.sh "$out/each" "$out/means" "$out/same-frames" "$out/$1" "${@:3}"
  rm -r "$out/each"  # 100 MB
}

value() { sed -n "s/^ *\"$1\": \([^,]*\),\{0,1\}$/\1/p" "$out/evaluation.json" | head -n 1; }

accuracy()  # LABEL RESULT...: means over results
{
  local label=$1 result align key; shift
  for result in "$@"; do
    for align in rigid none; do
      "$slamot" evaluate "$out/$result" --truth $log.truth --align $align --json >"$out/evaluation.json"
      value position_rmse_m
    done
    for key in mapped true rmse_m correct wrong nees_mean; do value $key; done
  done | paste -d' ' - - - - - - - - | awk -v label="$label" '
    { for (i = 1; i <= NF; i++) s[i] += $i / 1; false_ones += $3 - $4 }
    END { printf "%-42s %-18s %-22s %-16s %.1f\n", label, sprintf("%.4f, %.4f", s[2] / NR, s[1] / NR),
          sprintf("%.1f, %.1f, %.4f", s[3] / NR, false_ones / NR, s[5] / NR),
          sprintf("%.0f, %.1f", s[6] / NR, s[7] / NR), s[8] / NR }'
}

print_accuracy()
{
  local i known=() nn=()
  for ((i = 1; i <= rounds; i++)); do known+=(known-$i) nn+=(nn-$i); done
  printf '\n%-42s %-18s %-22s %-16s %s\n%-42s %-18s %-22s %-16s %s\n' '' 'path rmse [m]' 'landmarks' 'pairings' 'NEES' \
    "slamot: mean of $rounds seeds" 'raw, aligned' 'all, false, rmse [m]' 'right, wrong' '3 expected'
  accuracy 'slamot' "${known[@]}"
  accuracy 'kf-slam' kf-known-result
  accuracy 'slamot, no identities' "${nn[@]}"
  accuracy 'kf-slam, no identities' kf-nn-result
}

rm -rf "$out"
mkdir -p "$out"
"$files" forget-ids $data.rawlog $log.noid.rawlog
time_all
make_truth
slamot_run 1 same-frames --set log.first_frame=skip
kf_result kf-known-result $data.rawlog known
kf_result kf-nn-result $log.noid.rawlog
print_times
print_accuracy
