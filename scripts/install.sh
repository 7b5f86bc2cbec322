#!/bin/bash
# Installs those of the named Debian packages that are missing: scripts/install.sh [--missing] PACKAGE ... As root, or with sudo.
# --missing: only says which these are.
set -euo pipefail
only=no
[ "${1:-}" != --missing ] || { only=yes; shift; }
missing=""
for package in "$@"; do
	[ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=" $package"
done
[ -n "$missing" ] || exit 0
if [ $only = yes ]; then echo $missing; exit; fi
echo "installing:$missing"
root=""
[ "$(id -u)" = 0 ] || root="sudo -n"
export DEBIAN_FRONTEND=noninteractive
$root apt-get update -q
$root apt-get install -q -y --no-install-recommends $missing
