#!/bin/bash
# How the code looks: clang-format, yapf, flake8, no comment that goes on with another one's sentence, and no line beyond 160 columns in any
# document; and patches of tests/breakages that can be applied. scripts/lint.sh checks, scripts/lint.sh fix formats.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install.sh clang-format yapf3 flake8

mapfile -t cpp < <(git ls-files '*.cpp' '*.hpp')
mapfile -t py < <(git ls-files '*.py')
mapfile -t text < <(git ls-files '*.md' '*.sh' '*.py' '*CMakeLists.txt')
if [ "${1:-}" = fix ]; then
	clang-format -i "${cpp[@]}"
	for pass in 1 2; do yapf3 -i -p "${py[@]}"; done # what yapf has broken up it breaks differently the second time
	exit
fi
failed=0
for patch in tests/breakages/*.patch; do git apply --check "$patch" || failed=1; done # what cannot be applied breaks nothing
if grep -nE '//[/<]* \.\.\.' "${cpp[@]}"; then # a comment stands for itself
	echo "these comments go on with a sentence of another one"
	failed=1
fi
clang-format --dry-run -Werror "${cpp[@]}" || failed=1
yapf3 -d -p "${py[@]}" || failed=1
flake8 "${py[@]}" || failed=1
python3 - "${text[@]}" <<'EOF' || failed=1
import sys
bad = 0
for name in sys.argv[1:]: # a row of a table cannot be broken; strings in C++ are clang-format's business
	for number, line in enumerate(open(name, encoding="utf8"), 1):
		columns = len(line.rstrip("\n").expandtabs(8))
		if columns > 160 and not (name.endswith(".md") and line.lstrip().startswith("|")):
			print(f"{name}:{number}: {columns} columns")
			bad = 1
sys.exit(bad)
EOF
exit $failed
