#!/bin/sh
# The site and its API pages in FOLDER/html, Doxygen's XML in FOLDER/docs; any warning of either program fails.
# usage: site.sh SOURCE_DIR BUILD_DIR FOLDER
set -eu
mkdocs build --quiet --strict --config-file "$1/mkdocs.yml" --site-dir "$3/html"
rm -f "$3"/html/sitemap.xml*  # without an address of the site they say nothing
mkdir -p "$3/docs"
{ cat "$2/docs/Doxyfile"; echo "OUTPUT_DIRECTORY = $3"; } | doxygen -
