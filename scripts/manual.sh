#!/bin/bash
# Builds the manual: scripts/manual.sh. It is then in build/manual/html/index.html and needs no network.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --brief python3-sphinx python3-myst-parser python3-shapely python3-scipy
export PYTHONPATH="$PWD/py${PYTHONPATH:+:$PYTHONPATH}"
[ -v HOME ] || export HOME=~ # YADE does not start without
rm -rf build/manual
mkdir -p build/manual
cp -r py/manual build/manual/source
cp -r scripts/examples build/manual/source/examples # pages show these files
for part in figures classes; do
	yade -n -x -j1 "py/manual/$part.py" "build/manual/source/$part" > build/manual/log 2>&1 || { cat build/manual/log >&2; exit 1; }
done
/usr/bin/python3 -m sphinx -q -W --keep-going -b html build/manual/source build/manual/html
/usr/bin/python3 py/manual/links.py build/manual/html
echo "see build/manual/html/index.html"
