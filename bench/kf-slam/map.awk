# kf-slam's last map as a landmarks.csv, in the order of its state.
#   NAMES: a line `place id sightings` for each landmark;  COV: a full_cov_N.txt;  MEANS: a line `x y` for each
#   LC_ALL=C awk -f map.awk NAMES COV MEANS >landmarks.csv
FNR == 1 { file++ }
file == 1 { name[$1] = $2; seen[$1] = $3; known++; next }
file == 2 { for (j = 1; j <= NF; j++) c[FNR, j] = $j; next }
FNR == 1 { print "id,x,y,cxx,cxy,cyy,sightings" }
{
  k = 2 + 2 * FNR  # after the robot's x, y and heading
  printf "%d,%s,%s,%s,%s,%s,%d\n", name[FNR - 1], $1, $2, c[k, k], c[k, k + 1], c[k + 1, k + 1], seen[FNR - 1]
}
END { exit FNR != known }
