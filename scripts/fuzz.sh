#!/bin/bash
# Random input, at scale: scripts/fuzz.sh part=geometry|scenes|softening [count=N] [seed=N]. Ends with the number of cases that nothing explains, and fails if
# there are any.
# Each part is a program of its own in tests/fuzz/: `part` is looked up in the list below.
set -euo pipefail
cd "$(dirname "$0")/.."

part= count=1000 seed=1
for argument in "$@"; do
	case "$argument" in
		part=*) part="${argument#part=}" ;;
		count=*) count="${argument#count=}" ;;
		seed=*) seed="${argument#seed=}" ;;
		*) echo "'$argument' is none of part=, count=, seed=" >&2; exit 2 ;;
	esac
done
for number in "$count" "$seed"; do
	[[ "$number" =~ ^[0-9]+$ ]] || { echo "count and seed must be whole numbers, got '$number'" >&2; exit 2; }
done

scripts/setup.sh --brief
case "$part" in
	geometry) build/tests/geometry_fuzz "$count" "$seed" ;;
	scenes) build/tests/scene_fuzz "$count" "$seed" ;;
	softening) build/tests/scene_fuzz "$count" "$seed" 0 soften ;; # the same scenes with joints that soften
	*) echo "part must be geometry, scenes or softening, got '$part'" >&2; exit 2 ;;
esac
