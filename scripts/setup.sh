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
				python3-ezdxf python3-svgelements python3-sphinx python3-myst-parser xvfb xauth"
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
share() { # ninja's lines -> how far it is: in place on a terminal, else a line for every fifth; nothing where nothing is to be done
	local line said=no last=0 part
	building() { [ $said = yes ] || { said=yes; say "building the plugin in build/ (the first time takes some minutes)"; }; }
	[ -f build/libyadeblocks.so ] || building # ninja itself is silent until its first step is done, half a minute on a busy machine
	while IFS= read -r line; do # awk would wait for 4096 bytes
		echo "$line" >> "$log"
		[[ "$line" =~ ^\[([0-9]+)/([0-9]+)\]\ (Building|Linking) ]] || continue
		building
		part=$((5 * BASH_REMATCH[1] / BASH_REMATCH[2]))
		if [ -t 2 ]; then printf '\ryade-blocks: %s of %s steps done ' "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" >&2
		elif [ $part -gt $last ]; then last=$part; say "${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} steps done"
		fi
	done
	[ $said = no ] || [ ! -t 2 ] || echo >&2
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
else "${build[@]}" 2>&1 | share || { cat "$log" >&2; exit 1; }
fi
