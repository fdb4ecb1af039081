# A path of poses, `x y z yaw pitch roll` a line, as MRPT writes its truth, as a TUM trajectory: the n-th
# pose at the n-th time of TIMES, a robot.tum.  Exit status 1 unless there are as many of both.
#   LC_ALL=C awk -f path.awk TIMES PATH >robot.tum
/^[ \t]*(%.*)?$/ { next }
NR == FNR { time[++times] = $1; next }
NF != 6 { broken = 1 }
++poses <= times { printf "%s %.9f %.9f 0 0 0 %.9f %.9f\n", time[poses], $1, $2, sin($4 / 2), cos($4 / 2) }
END { exit broken || poses != times }
