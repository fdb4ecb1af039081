#!/usr/bin/env bash
# Makes the packages of a build tree and looks at what is in them.
# usage: packages.sh SOURCE_DIR BUILD_DIR FOLDER INSTALLED    INSTALLED: what cmake --install made
set -eu
source=$1 build=$2 folder=$3 installed=$4
rm -rf "$folder"
mkdir -p "$folder"
cpack --config "$build/CPackConfig.cmake" -B "$folder/packages" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip \
  >"$folder/cpack.log" 2>&1 || { cat "$folder/cpack.log"; exit 1; }
cd "$folder"
mkdir tree
complain() { printf 'packages.sh: error: %s\n' "$*" | tee -a complaints; }
# nothing WHAT: complains of each line that comes in.
nothing() { while IFS= read -r line; do complain "$1: $line"; done; }

for package in packages/*.deb; do
  name=$(dpkg-deb --field "$package" Package)
  dpkg-deb --extract "$package" "tree/$name"
  (cd "tree/$name" && find . ! -type d -printf '%P\n') | sort >"$name.files"
  echo "$name"
done | sort >names
version=$(dpkg-deb --field packages/slamot_*.deb Version)
printf '%s\n' "libslamot${version%.*}" libslamot-dev slamot slamot-doc slamot-mrpt-plugin | sort |
  diff - names | nothing "packages"

# All that is installed is in a package, and in one only, but for what each package has of its own.
sort -- *.files | uniq -d | nothing "in two packages"
own='^usr/share/(doc/[^/]*/(copyright|changelog.Debian.gz)|lintian/overrides/.*)$'
(cd "$installed" && find . ! -type d -printf 'usr/%P\n') | sort >installed.files
sort -- *slamot*.files | grep -Ev "$own" | diff installed.files - | nothing "installed (<) or packed (>) alone"
while read -r name; do
  for file in copyright changelog.Debian.gz; do
    [ -s "tree/$name/usr/share/doc/$name/$file" ] || complain "$name has no $file"
  done
  zcat "tree/$name/usr/share/doc/$name/changelog.Debian.gz" | head -n 1 | grep -qF "($version)" ||
    complain "$name: the changelog begins with another version than $version"
done <names

# What is of the machine that built it is of no use elsewhere.
grep -rlF -e "$build" -e "$source" tree | nothing "names a folder of the build"
find tree -type f \( -name '*.so*' -o -path '*/bin/*' \) | while read -r file; do
  readelf -d "$file" | sed -n 's/.*\(RPATH\|RUNPATH\).*\[\(.*\)\]/\2/p' | tr : '\n' | grep -v '^\$ORIGIN' |
    nothing "$file is run with libraries of"
  case $file in
    */lib/*/slamot/*) ;;
    *.so.*) name=$(basename "$file")
      [ "${name%.*}" = "$(readelf -d "$file" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')" ] ||
        complain "$file has the name of another interface" ;;
  esac
done

# What it takes to run, by the names of programs and by libraries.
field() { dpkg-deb --field packages/"$1"_*.deb "$2"; }
for wanted in "slamot Depends libslamot" "slamot Recommends gnuplot" "slamot Recommends libegl-mesa0" \
  "libslamot${version%.*} Depends libmrpt-obs" "libslamot-dev Depends libmrpt-slam-dev" \
  "libslamot-dev Depends slamot-mrpt-plugin" "slamot-mrpt-plugin Recommends mrpt-apps"; do
  set -- $wanted
  field "$1" "$2" | grep -q "$3" || complain "$1 lacks $3 in $2"
done
desktop-file-validate tree/slamot-mrpt-plugin/usr/share/applications/*.desktop | nothing "menu"
[ ! -s complaints ]
