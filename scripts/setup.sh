#!/bin/bash
# Makes everything ready to run: Debian packages (if any is missing), configuration, build in build/. May be repeated at any time.
set -euo pipefail
cd "$(dirname "$0")/.."

packages="yade libyade python3-yade libeigen3-dev libcgal-dev libboost-dev libboost-python-dev libboost-numpy-dev libboost-serialization-dev
	libgmp-dev libmpfr-dev python3-dev python3-numpy python3-scipy python3-pandas python3-matplotlib python3-pytest python3-meshio
	libgtest-dev cmake g++ ninja-build binutils"

missing=""
for package in $packages; do
	[ "$(dpkg-query -W -f '${db:Status-Status}' $package 2>/dev/null)" = installed ] || missing+=" $package"
done
if [ -n "$missing" ]; then
	echo "installing:$missing"
	root=""
	[ "$(id -u)" = 0 ] || root="sudo -n"
	export DEBIAN_FRONTEND=noninteractive
	$root apt-get update -q
	$root apt-get install -q -y --no-install-recommends $missing
fi

mkdir -p build
exec 9> build/.setup-lock
flock 9 # two runs at once must not build at once
[ -f build/build.ninja ] || [ -f build/Makefile ] || cmake -S . -B build -G Ninja
cmake --build build -j "$(nproc)"
