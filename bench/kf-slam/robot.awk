# The path that kf-slam wrote at every step, as a robot.csv.  TIMES is a robot.csv of the same log, with
# its start; then come pairs robot_pose_N.txt full_cov_N.txt in order of N.
#   LC_ALL=C awk -f robot.awk TIMES robot_pose_00000.txt full_cov_00000.txt ... >robot.csv
function row(t) { printf "%s,%s,%s,%s,%s,%s,%s,%s,%s,%s\n", t, x[1], x[2], x[3], c[1, 1], c[1, 2], c[1, 3], c[2, 2], c[2, 3], c[3, 3] }
FNR == 1 { file++ }
file == 1 { split($0, field, ","); if (FNR > 1) time[FNR - 1] = field[1]; else print; next }
file == 2 && FNR == 1 { for (i = 1; i <= 3; i++) { x[i] = 0; for (j = 1; j <= 3; j++) c[i, j] = 0 } row(time[1]) }
file % 2 == 0 { x[FNR] = $1; next }
FNR <= 3 { for (j = 1; j <= 3; j++) c[FNR, j] = $j }
FNR == 3 { row(time[1 + (file - 1) / 2]); nextfile }
