#!/bin/sh
# Makes the site without a network, and looks for dead links and for files that a page loads from elsewhere.
#   site_test.sh FOLDER
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
if ! dpkg-query -W $(sed 's/#.*//' "$root/docs/packages.txt") > /dev/null 2>&1; then
  echo "SKIPPED: the site of the documents, packages of docs/packages.txt are missing"
  exit 77
fi
# An empty network namespace, where the system allows one.
if unshare -n true 2> /dev/null; then
  exec unshare -n "$root/docs/site.sh" "$1"
fi
exec "$root/docs/site.sh" "$1"
