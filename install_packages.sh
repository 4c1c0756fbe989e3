#!/bin/sh
# Installs what packages.txt lists and this machine lacks, with apt-get, as root or through sudo. NOOK_PACKAGES names another
# list.
set -eu
list="${NOOK_PACKAGES:-$(dirname "$0")/packages.txt}"
if ! command -v dpkg-query > /dev/null; then
  echo "install_packages.sh: this is no Debian; install the equivalents of $list by hand" >&2
  exit 0
fi
missing=""
for package in $(sed 's/#.*//' "$list"); do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0
as_root=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "install_packages.sh: these packages are missing and need root or sudo:$missing" >&2
    exit 1
  fi
  as_root="sudo"
fi
echo "installing:$missing"
$as_root apt-get update -q
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
