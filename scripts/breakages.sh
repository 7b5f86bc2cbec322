#!/bin/bash
# Does a test notice? scripts/breakages.sh [NAME ...] applies patches of tests/breakages (all of them without a name), one at a time, to what is committed, in a
# scratch clone in build/breakages, builds what its test needs and runs that. Fails if a breakage is not noticed, or cannot be applied or built.
set -euo pipefail
cd "$(dirname "$0")/.."
root="$PWD" scratch="$PWD/build/breakages"

patches=()
for name in "$@"; do
	patches+=("$root/tests/breakages/$name.patch")
	[ -f "${patches[-1]}" ] || { echo "there is no tests/breakages/$name.patch" >&2; exit 2; }
done
[ $# -gt 0 ] || patches=("$root"/tests/breakages/*.patch)

[ -d "$scratch/.git" ] || git clone -q --shared "$root" "$scratch"
cd "$scratch"
git fetch -q "$root" HEAD
git checkout -q -f --detach FETCH_HEAD
cmake -S . -B build -G Ninja > build.log 2>&1 || { cat build.log >&2; exit 1; }

# Builds and runs a test: 0 if it passes, 1 if it fails, 2 if it cannot be built.
runTest() {
	local kind="$1" what="$2" target=kernel_tests
	[ "$kind" = kernel ] || target=yadeblocks
	cmake --build build --target "$target" -j 2 > build.log 2>&1 || return 2
	if [ "$kind" = kernel ]; then
		timeout 600 build/tests/kernel_tests --gtest_filter="$what" > test.log 2>&1 || return 1
		! grep -q "Running 0 tests" test.log || return 2
	else
		local words
		eval "words=($what)" # quotes after -k
		YADEBLOCKS_PLUGIN="$scratch/build/libyadeblocks.so" PYTHONPATH="$scratch/py:$(ls -d /usr/lib/*/yade-double/py)" OMP_NUM_THREADS=1 \
			timeout 600 /usr/bin/python3 tests/runInYade.py "tests/yade/${words[0]}" "${words[@]:1}" > test.log 2>&1 || return 1
	fi
}

bad=0
for patch in "${patches[@]}"; do
	name="$(basename "$patch" .patch)" outcome=0
	git checkout -q -f FETCH_HEAD
	kind="$(sed -n 's/^Test: \([a-z]*\) .*/\1/p' "$patch")" what="$(sed -n 's/^Test: [a-z]* //p' "$patch")"
	if ! git apply "$patch" 2> build.log; then
		echo "$name: cannot be applied"; bad=1; continue
	fi
	runTest "$kind" "$what" || outcome=$?
	case $outcome in
		0) echo "$name: NOT NOTICED by $what"; bad=1 ;;
		1) echo "$name: noticed" ;;
		*) echo "$name: cannot be built, or its test does not exist (see $scratch/build.log)"; bad=1 ;;
	esac
done
git checkout -q -f FETCH_HEAD
exit $bad
