#!/bin/bash
# Makes everything ready to run: scripts/setup.sh [--tests] [--brief] [PACKAGE ...]. Installs the Debian packages that the plugin and its scenarios need, and
# those that are named, for commands that need more, if any is missing; builds the plugin in build/, with --tests the tests as well. May be repeated at any
# time. --brief: a line on stderr for each thing that takes time, and how far it is; all the rest only where something fails.
set -euo pipefail
cd "$(dirname "$0")/.."

packages="yade libyade python3-yade libeigen3-dev libcgal-dev libboost-dev libboost-python-dev libboost-numpy-dev libboost-serialization-dev
	libgmp-dev libmpfr-dev libsuitesparse-dev python3-dev python3-numpy python3-pandas python3-matplotlib python3-meshio cmake g++ ninja-build binutils"
tests=OFF brief=no target="--target yadeblocks"
while [[ "${1:-}" = --* ]]; do
	case "$1" in
		--tests)
			tests=ON target=""
			packages+=" python3-pytest libgtest-dev python3-scipy python3-distributed python3-optuna python3-openturns python3-shapely
				python3-ezdxf python3-svgelements"
			;;
		--brief) brief=yes ;;
		*) echo "setup.sh knows --tests and --brief, got $1" >&2; exit 2 ;;
	esac
	shift
done

log="$(mktemp)"
trap 'rm -f "$log"' EXIT
say() { [ $brief = no ] || echo "yade-blocks: $*" >&2; }
run() { # a command whose output matters only if it fails
	if [ $brief = no ]; then "$@"
	else "$@" > "$log" 2>&1 || { code=$?; cat "$log" >&2; exit $code; }
	fi
}
share() { # ninja's lines -> a line for every fifth of them
	awk -v log_="$log" -F'[][/]' '{ print > log_ } $2 ~ /^[0-9]+$/ && $3 > 0 { part = int(5 * $2 / $3)
		if (part > last) { last = part; print "yade-blocks: " $2 " of " $3 " steps done" > "/dev/stderr" } }'
}

missing="$(scripts/install.sh --missing $packages "$@")"
if [ -n "$missing" ]; then
	say "installing $(wc -w <<< "$missing") Debian packages:" $missing
	run scripts/install.sh $missing
fi

mkdir -p build
exec 9> build/.setup-lock
flock -n 9 || { say "another command is building; waiting for it"; flock 9; } # two runs at once must not build at once
known="$(sed -n 's/^BUILD_TESTING:BOOL=//p' build/CMakeCache.txt 2>/dev/null || true)"
if [ ! -f build/build.ninja ] && [ ! -f build/Makefile ]; then
	say "first build: looking for compiler and libraries"
	run cmake -S . -B build -G Ninja -DBUILD_TESTING=$tests
elif [ $tests = ON ] && [ "$known" != ON ]; then run cmake -S . -B build -DBUILD_TESTING=ON
fi
build=(cmake --build build -j "$(nproc)" $target)
if [ $brief = no ]; then "${build[@]}"
elif [ -f build/build.ninja ] && ninja -C build -n ${target#--target} 2>&1 | grep -q 'no work to do'; then :
else
	say "building the plugin in build/ (the first time takes some minutes)"
	if [ -t 2 ]; then "${build[@]}" >&2 # ninja shows in place how far it is
	else "${build[@]}" 2>&1 | share || { cat "$log" >&2; exit 1; }
	fi
fi
