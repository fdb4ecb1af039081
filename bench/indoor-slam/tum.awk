# A path as MRPT's icp-slam (`step x y yaw`) or rbpf-slam (`x y yaw`, or with z, pitch and roll) writes it, as a TUM trajectory at
# the times of TIMES, a robot.tum of the same log.  Either may have a row more, of the start: it is left out.
# Exit status 1 if the numbers of rows differ by more.
#   LC_ALL=C awk -f tum.awk TIMES PATH >path.tum
/^[ \t]*(%.*)?$/ { next }
NR == FNR { time[++times] = $1; next }
{
  poses++
  if (NF == 4) { x[poses] = $2; y[poses] = $3; yaw[poses] = $4 }
  else if (NF == 3) { x[poses] = $1; y[poses] = $2; yaw[poses] = $3 }
  else if (NF == 6) { x[poses] = $1; y[poses] = $2; yaw[poses] = $4 }
  else broken = 1
}
END {
  first = times - poses
  if (broken || first > 1 || first < -1) exit 1
  for (i = first > 0 ? 1 : 1 - first; i <= poses; i++)
    printf "%s %.9f %.9f 0 0 0 %.9f %.9f\n", time[i + first], x[i], y[i], sin(yaw[i] / 2), cos(yaw[i] / 2)
}
