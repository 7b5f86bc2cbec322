#!/bin/bash
# The kernel and its tests built in other ways: scripts/check.sh [KIND ...]; arguments behind -- go to the tests (e.g. -- --gtest_filter='Joint*').
#   strict      warnings are errors, in the plugin too
#   assertions  with assertions, Eigen's and the library's own bounds checks; warnings are errors
#   narrow      without the loops for AVX2: the plugin must give the same golden fingerprints
#   address     sanitizers for addresses and undefined behaviour
#   thread      the sanitizer for threads, on what runs in parallel
# Without KIND: all of them. Each is a preset of .github/CMakePresets.json and is built in a folder of its own, build/check-KIND.
set -euo pipefail
cd "$(dirname "$0")/.."
kinds=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do kinds+=("$1"); shift; done
[ $# -eq 0 ] || shift
[ ${#kinds[@]} -gt 0 ] || kinds=(strict assertions narrow address thread)
for kind in "${kinds[@]}"; do
	case $kind in strict | assertions | narrow | address | thread) ;; *)
		echo "check: '$kind' is not one of strict, assertions, narrow, address, thread" >&2
		exit 2
		;;
	esac
done
scripts/setup.sh --tests
[ -v HOME ] || export HOME=~ # YADE does not start without

ln -sfn .github/CMakePresets.json CMakePresets.json # where CMake looks for it

for kind in "${kinds[@]}"; do
	echo "== $kind"
	cmake --preset "$kind" > /dev/null
	cmake --build --preset "$kind" -j "$(nproc)"
	case $kind in
	assertions | address)
		"build/check-$kind/tests/kernel_tests" --gtest_brief=1 "$@"
		;;
	narrow)
		ctest --test-dir build/check-narrow -R '^yade.test_(step|threads)$' --output-on-failure
		;;
	thread)
		# GNU's OpenMP synchronises where the sanitizer cannot see it: what runs between its barriers is reported although it is in order.
		TSAN_OPTIONS="ignore_noninstrumented_modules=1 ${TSAN_OPTIONS:-}" build/check-thread/tests/kernel_tests --gtest_brief=1 \
			--gtest_filter="${GTEST_FILTER:-*Thread*}" "$@"
		;;
	esac
done
