#!/bin/bash
# Makes everything ready to run: scripts/setup.sh [--tests] [PACKAGE ...]. Installs the Debian packages that the plugin and its scenarios need, and those
# that are named, for commands that need more, if any is missing; builds the plugin in build/, with --tests the tests as well. May be repeated at any time.
set -euo pipefail
cd "$(dirname "$0")/.."

packages="yade libyade python3-yade libeigen3-dev libcgal-dev libboost-dev libboost-python-dev libboost-numpy-dev libboost-serialization-dev
	libgmp-dev libmpfr-dev libsuitesparse-dev python3-dev python3-numpy python3-pandas python3-matplotlib python3-meshio cmake g++ ninja-build binutils"
tests=OFF
if [ "${1:-}" = --tests ]; then
	tests=ON
	packages+=" python3-pytest libgtest-dev python3-scipy python3-distributed python3-optuna python3-openturns"
	shift
fi
scripts/install.sh $packages "$@"

mkdir -p build
exec 9> build/.setup-lock
flock 9 # two runs at once must not build at once
known="$(sed -n 's/^BUILD_TESTING:BOOL=//p' build/CMakeCache.txt 2>/dev/null || true)"
if [ ! -f build/build.ninja ] && [ ! -f build/Makefile ]; then cmake -S . -B build -G Ninja -DBUILD_TESTING=$tests
elif [ $tests = ON ] && [ "$known" != ON ]; then cmake -S . -B build -DBUILD_TESTING=ON
fi
if [ $tests = ON ]; then cmake --build build -j "$(nproc)"
else cmake --build build -j "$(nproc)" --target yadeblocks
fi
