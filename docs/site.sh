#!/bin/sh
# Makes the site of the documents, with search, from the Markdown pages, by Sphinx, MyST and the theme Furo of Debian.
#   docs/site.sh [FOLDER]           the default is build-site; the site is FOLDER/html/index.html
# It reads and fetches nothing from elsewhere: packages.txt lists what has to be installed.
set -eu
cd "$(dirname "$0")/.."
folder=${1:-build-site}
NOOK_PACKAGES=docs/packages.txt ./install_packages.sh
rm -rf "$folder/source" "$folder/html"
# Debian's Sphinx belongs to Debian's Python.
python=/usr/bin/python3
[ -x "$python" ] || python=python3
"$python" docs/site/gather.py "$folder/source"
"$python" -m sphinx -b html -W --keep-going -q -c docs/site -d "$folder/doctrees" "$folder/source" "$folder/html"
"$python" docs/site/theme.py "$folder/html"
mkdir -p "$folder/html/files"
cp -R "$folder/source/files/." "$folder/html/files"
# The page of the browser sample, where it was built.
[ ! -e build-web/site/index.html ] || cp -R build-web/site "$folder/html/live"
"$python" docs/site/check.py "$folder/html"
"$python" docs/site/check_search.py "$folder/html"
echo "open $folder/html/index.html"
