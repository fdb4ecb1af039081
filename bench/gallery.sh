#!/usr/bin/env bash
# The tables of doc/gallery.md: every filter on every kind of data, with errors, consistency and CPU time.
# usage: bench/gallery.sh simulated [NAME=PATH]...    data that you got yourself: mrclam=FOLDER, victoria-park=FOLDER,
#   scaled-cars=FOLDER, intel=LOG[,RELATIONS], csail=LOG; tables of data that are not given stay as they are.  ./dev build first.
# Of Debian: python3; mrpt-common for MRPT's own logs.  SEEDS (10) of simulated worlds, LUCK (5) seeds of filters that draw, on real
# data; ONLY=REGEX: tables it matches.  PICTURES=1 draws those of doc/images too (imagemagick).
# Results stay in slamot-out/gallery; a rerun does only what is missing, so remove the folder after a change of the program.
set -euo pipefail
from=$PWD
cd "$(dirname "$(readlink -f "$0")")/.."
export LC_ALL=C
seeds=${SEEDS:-10} luck=${LUCK:-5} only=${ONLY:-.} pictures=${PICTURES:-}
slamot=${SLAMOT_BUILD:-build}/apps/slamot/slamot out=slamot-out/gallery page=doc/gallery.md
die() { printf 'gallery.sh: error: %s\n' "$*" >&2; exit 1; }
say() { printf '%s\n' "$*" >&2; }
[ $# -gt 0 ] || { echo "gallery.sh: skipped: it rewrites $page; say so: bench/gallery.sh simulated"; exit 0; }
[ -x "$slamot" ] || die "$slamot is missing: run ./dev build"
slamot=$(readlink -f "$slamot")
command -v python3 >/dev/null || die "python3 is missing: apt-get install python3"
[[ $seeds =~ ^[1-9][0-9]*$ && $luck =~ ^[1-9][0-9]*$ ]] || die "SEEDS and LUCK are numbers from 1 on"

declare -A given=()
for data in "$@"; do
  [ "$data" != simulated ] || continue
  [[ $data =~ ^(mrclam|victoria-park|scaled-cars|intel|csail)=(.+)$ ]] || die "'$data' is no data: give NAME=PATH, as the head of this file says"
  given[${BASH_REMATCH[1]}]=${BASH_REMATCH[2]}
done

# begin NAME: a table of that name; false where it is not asked for.
begin()
{
  [[ $1 =~ $only ]] || return 1
  table=$1 judged=()
  mkdir -p "$out/$table"
  : >"$out/$table/rows"
  : >"$out/$table/commands"
  say "== $table"
}
# has NAME [FOLDER]: whether the data were given; else says so.
has() { [ -n "${given[$1]:-}" ] || { say "   skipped: no data: give $1=PATH"; return 1; }; }
# path NAME [,]: of the data, or of what follows the comma.
path()
{
  local file=${given[$1]%%,*}
  [ $# = 1 ] || file=${given[$1]#*,}
  (cd "$from" && readlink -e "$file") || die "$file is not there"
}

shown() { printf '%s\n' "$*" >>"$out/$table/commands"; }
# make LOG COMMAND...: a log, unless it is there.
make() { local log=$1; shift; [ -e "$log" ] || "$slamot" "$@" -q -o "$log"; }

# simulated SCENARIO [OPTIONS]: a world of its own for each seed.
simulated()
{
  local scenario=$1 seed; shift
  logs=() worlds=1
  for ((seed = 1; seed <= seeds; seed++)); do
    make "$out/$table/$table-$seed.rawlog" simulate "config-ini/$scenario" --seed $seed "$@"
    logs+=("$out/$table/$table-$seed.rawlog")
  done
  name=$table.rawlog
  shown "slamot simulate config-ini/$scenario -o $name --seed N${*:+ $*}"
}
# detected CONFIG: what is found in the images and scans of these logs takes their place.
detected()
{
  local i seen
  for i in "${!logs[@]}"; do
    seen=${logs[i]%.rawlog}.seen.rawlog
    make "$seen" detect "config-ini/$1" "${logs[i]}"
    ln -sfn "$(basename "${logs[i]%.rawlog}").truth" "${seen%.rawlog}.truth"
    logs[i]=$seen
  done
  shown "slamot detect config-ini/$1 $name -o $table.seen.rawlog"
  name=$table.seen.rawlog
}
# logged LOG NAME: one log, the same for all seeds; NAME as commands have it.
logged() { logs=("$1") worlds= name=$2; }
# imported NAME KIND SOURCE [OPTIONS]: the same of data in another format.
imported()
{
  local log=$out/$table/$1.rawlog kind=$2 source=$3; shift 3
  make "$log" import "$kind" "$source" "$@"
  logged "$log" "$(basename "$log")"
  shown "slamot import $kind $(basename "$source") -o $name$(for word in "$@"; do printf ' %s' "${word##/*/}"; done)"
}

# row LABEL CONFIG [OPTIONS]: a filter on these logs; one that draws nothing runs once on a log.
row()
{
  local label=$1 config=$2 folder log seed runs i; shift 2
  folder=$out/$table/$(printf '%s' "$label" | tr -cs 'a-z0-9-' _)
  mkdir -p "$folder"
  printf '%s\t%s\n' "$(basename "$folder")" "$label" >>"$out/$table/rows"
  shown "slamot run config-ini/$config $name --seed N${*:+ $*}"
  runs=${#logs[@]}
  [ -n "$worlds" ] || runs=$luck
  for ((i = 0; i < runs; i++)); do
    seed=$((i + 1)) log=${logs[worlds ? i : 0]}
    [ -e "$folder/$seed.json" ] || run_one "$folder" $seed "$log" "$config" "$@"
    [ -n "$worlds" ] || ! grep -q '"count": null' "$folder/1.json" || break
  done
}
run_one()  # FOLDER SEED LOG CONFIG [OPTIONS]
{
  local folder=$1 seed=$2 log=$3 config=$4; shift 4
  rm -rf "$folder/run"
  "$slamot" run "config-ini/$config" "$log" --seed "$seed" -q -o "$folder/run" "$@"
  "$slamot" evaluate "$folder/run" "${judged[@]}" --json >"$folder/$seed.evaluation"
  awk 'NR == 1 { first = $1 } END { print $1 - first }' "$folder/run/robot.tum" >"$folder/$seed.duration"
  [ "$seed" != 1 ] || { rm -rf "$folder/first"; cp -r "$folder/run" "$folder/first"; }
  mv "$folder/run/summary.json" "$folder/$seed.json"
  rm -rf "$folder/run"
}

# picture LABEL [OPTIONS of slamot render]: of the first seed, to doc/images, in few colours.
picture()
{
  local folder; folder=$out/$table/$(printf '%s' "$1" | tr -cs 'a-z0-9-' _)
  [ -n "$pictures" ] || return 0
  "$slamot" render "$folder/first" -o "$out/$table.png" --width 1280 --height 800 "${@:2}" >&2
  convert "$out/$table.png" -resize 900x -colors 48 -depth 8 -define png:compression-level=9 -strip "doc/images/gallery-$table.png"
}

# end COLUMNS: puts the table into the page.
end() { python3 bench/gallery/table.py "$out/$table" "$table" "$page" "$@"; }

source bench/gallery/tables.sh
