#!/usr/bin/env bash
# Two robots and a target across a world of 1000 m with 1600 landmarks, without exchange, with
# covariance intersection and with one EKF for all: mean errors over time, in the manner of Figs. 3-5
# of the paper on EKF-SLAMOT teams.
#   bench/team-world.sh [SEEDS] [OUT]     (3 seeds, slamot-out/team-world; ./dev build first)
set -euo pipefail
cd "$(dirname "$0")/.."
seeds=${1:-3} out=${2:-slamot-out/team-world}
slamot=${SLAMOT:-build/apps/slamot/slamot}
rules="none ci centralized"
mkdir -p "$out"

for seed in $(seq "$seeds"); do
  "$slamot" simulate config-ini/sim.ekf-slamot-ci.ini --seed "$seed" -q -o "$out/world$seed.rawlog"
  for rule in $rules; do
    "$slamot" team config-ini/team-ci.ini "$out"/world"$seed".robot{0,1}.rawlog -q \
      --set team.rule=$rule -o "$out/$rule-$seed"
  done
done

# errors FILE.tum TRUTH.tum: t and the distance, for the times that both have
errors() { awk 'NR == FNR { x[$1] = $2; y[$1] = $3; next }
                $1 in x { printf "%.1f %.6f\n", $1, sqrt(($2 - x[$1])^2 + ($3 - y[$1])^2) }' "$2" "$1"; }

# Mean over the seeds, and half of its 95% interval; of the target, each seed's mean over both robots.
for rule in $rules; do
  for what in robot0 robot1 target; do
    for seed in $(seq "$seeds"); do
      case $what in
        target) for r in 0 1; do
                  errors "$out/$rule-$seed/world$seed.robot$r/target_0.tum" "$out/world$seed.robot$r.truth/target_0.tum"
                done ;;
        *) errors "$out/$rule-$seed/world$seed.$what/robot.tum" "$out/world$seed.$what.truth/robot.tum" ;;
      esac | awk '{ n[$1]++; s[$1] += $2 } END { for (t in n) print t, s[t] / n[t] }'
    done | awk '{ n[$1]++; s[$1] += $2; q[$1] += $2 * $2 }
                END { for (t in n) { m = s[t] / n[t]; f = n[t] - 1; v = f > 0 ? (q[t] / n[t] - m * m) / f : 0
                                     student = f > 0 ? 1.96 + 2.37 / f + 2.82 / (f * f) : 0
                                     printf "%s %.6f %.6f\n", t, m, student * sqrt(v > 0 ? v : 0) } }' |
      sort -n >"$out/$rule-$what.dat"
  done
done

gnuplot <<PLOT
set terminal pngcairo size 1000,900 font "sans,11"
set output "$out/errors.png"
set multiplot layout 3,1 title "1000 m, 1600 landmarks, $seeds seeds: mean error [m] and its 95% interval"
set xlabel "time [s]"; set ylabel "error [m]"; set key left top; set grid lc rgb "#dddddd"
set yrange [0:*]
do for [what in "target robot0 robot1"] {
  set title what offset 0,-0.6
  plot for [i=1:3] "$out/".word("$rules", i)."-".what.".dat" every 5 using 1:(\$2-\$3):(\$2+\$3) with filledcurves \
         fs transparent solid 0.2 noborder lc rgb word("#D55E00 #0072B2 #009E73", i) notitle, \
       for [i=1:3] "$out/".word("$rules", i)."-".what.".dat" every 5 using 1:2 with lines lw 2 \
         lc rgb word("#D55E00 #0072B2 #009E73", i) title word("no-exchange ci centralized", i)
}
PLOT
for rule in $rules; do
  printf '%-12s' "$rule"
  for what in robot0 robot1 target; do
    awk -v what=$what '{ s += $2; last = $2; h = $3 } END { printf "  %s %.2f m mean, %.2f +- %.2f m at the end", what, s / NR, last, h }' "$out/$rule-$what.dat"
  done
  echo
done
echo "picture: $out/errors.png"
