#!/bin/sh
# Installs what packages.txt lists and this machine lacks, with apt-get, as root or through sudo. NOOK_PACKAGES names another
# list.
set -eu
list="${NOOK_PACKAGES:-$(dirname "$0")/packages.txt}"
if ! command -v dpkg-query > /dev/null; then
  echo "install_packages.sh: this is no Debian; install the equivalents of $list by hand" >&2
  exit 0
fi
# Packages of other origin may provide a listed one and conflict with it, as NodeSource's nodejs does with npm.
provided=$(dpkg-query -W -f '${db:Status-Status} ${Provides}\n' | sed -n 's/^installed //p' | tr ',' '\n' | sed 's/(.*//; s/ //g')
missing=""
for package in $(sed 's/#.*//' "$list"); do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$state" = installed ] || printf '%s\n' "$provided" | grep -qxF "$package" || missing="$missing $package"
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
if ! command -v apt-get > /dev/null; then
  echo "install_packages.sh: there is no apt-get; install these packages by hand:$missing" >&2
  exit 1
fi
echo "installing:$missing"
# The packages may be in a cache, so that a failure here is not the end.
$as_root apt-get update -q || echo "install_packages.sh: apt-get update failed; is there a network?" >&2
if ! $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing; then
  echo "install_packages.sh: apt-get cannot install these packages (its reason is above):$missing" >&2
  echo "install_packages.sh: it needs a network, the package lists of Debian 12 and no other apt-get that runs" >&2
  exit 1
fi
