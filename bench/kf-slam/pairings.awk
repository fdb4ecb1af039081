# kf-slam's data_association.log as a pairings.csv.  SEEN is a pairings.csv of the same sightings, for their
# times and what the log's own identities are.  With -v known=1 landmarks go by these, else by their places
# in kf-slam's state.  A landmark is new when it is first seen.  NAMES is written for map.awk.
#   LC_ALL=C awk -v names=NAMES [-v known=1] -f pairings.awk SEEN data_association.log >pairings.csv
NR == FNR { if (FNR == 1) print; else seen[FNR - 1] = $0; next }
/^%/ { next }
{
  split(seen[++n], s, ",")
  if (s[3] != $2) { broken = 1; exit }
  outcome = $3 < 0 ? "rejected" : $3 in id ? "known" : "new"
  if (outcome == "new") { id[$3] = known ? s[4] : $3; order[++landmarks] = $3 }
  if (outcome != "rejected") count[$3]++
  printf "%s,landmark,%d,%s,%s,%d\n", s[1], $2, s[4], outcome, $3 < 0 ? -1 : id[$3]
}
END {
  for (i = 1; i <= landmarks; i++) print order[i], id[order[i]], count[order[i]] >names
  exit broken || (n + 1) in seen
}
