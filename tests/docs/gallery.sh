#!/bin/sh
# Filters that can be made by name, and that doc/gallery.md does not speak of.
# usage: gallery.sh SLAMOT SOURCE_DIR FOLDER
set -eu
"$1" run "$2/config-ini/dead-reckoning.ini" "$2/share/datasets/experiment1.rawlog" --set run.method=? -o "$3" 2>&1 |
  sed -n 's/.*set it to //p' | tr -d ' ' | tr '|' '\n' >"$3.filters"
[ -s "$3.filters" ] || { echo "gallery.sh: error: slamot does not tell its filters"; exit 1; }
missing=0
while read -r filter; do
  grep -q "^| \`$filter\`" "$2/doc/gallery.md" || { echo "doc/gallery.md has no row for $filter"; missing=1; }
done <"$3.filters"
exit $missing
