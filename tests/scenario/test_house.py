# yade-blocks, GPL-2.0-or-later
"""The shape of the house: dependencies point one way."""
import re
import shutil
import subprocess
from pathlib import Path

import pytest

house = Path(__file__).resolve().parents[2]
includes = lambda path: re.findall(r'^\s*#\s*include\s*([<"][^>"]+[>"])', path.read_text(), re.M)


@pytest.mark.parametrize('path', sorted((house / 'pkg/blocks/kernel').rglob('*.?pp')), ids=lambda path: path.name)
def test_kernelKnowsNoYade(path):
	yade = [name for name in includes(path) if re.match(r'["<](core|lib|pkg|py)/|[<"]boost/python|[<"]Python', name)]
	assert not yade and 'namespace yade' not in path.read_text()


def test_kernelKnowsNoAdapter():
	adapters = {path.name for path in (house / 'pkg/blocks').glob('*.hpp')}
	for path in (house / 'pkg/blocks/kernel').rglob('*.?pp'):
		assert not adapters & {Path(name.strip('<>"')).name
					for name in includes(path) if 'kernel/' not in name} - {p.name for p in path.parent.iterdir()}, path


def test_noStrangeTopLevel():
	if not shutil.which('git'): pytest.skip('no git')
	listed = subprocess.run(['git', 'ls-files'], cwd=house, capture_output=True, text=True)
	if listed.returncode: pytest.skip('no git checkout')
	top = {name.split('/')[0] for name in listed.stdout.split()}
	assert {name for name in top if not name.startswith('.')} <= {'CMakeLists.txt', 'pkg', 'py', 'scripts', 'tests', 'README.md', 'LICENSE', 'CHANGELOG.md'}


@pytest.mark.parametrize('path', sorted((house / 'scripts').glob('*.py')) + sorted((house / 'scripts/examples').glob('*.py')), ids=lambda path: path.stem)
def test_scriptsSayWhichPackagesTheyNeed(path):
	"""scripts/run.sh installs what stands in a script's second line; on a bare machine nothing else is there."""
	text = path.read_text()
	needed = {'limitanalysis': 'scipy', 'packing': 'scipy', 'jointsets': 'shapely', 'rubble': 'shapely', 'Mortared': 'shapely'}
	imports = '\n'.join(re.findall(r'^from yadeblocks.*|^import .*', text, re.M))
	wanted = {f'python3-{package}' for name, package in needed.items() if re.search(rf'\b{name}\b', imports)}
	said = re.findall(r'\A#.*\n# needs: (.*)', text)
	assert wanted <= set(' '.join(said).split())
