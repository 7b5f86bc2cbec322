# yade-blocks, GPL-2.0-or-later
"""The shape of the house: dependencies point one way."""
import fnmatch
import re
import shutil
import subprocess
from graphlib import TopologicalSorter
from pathlib import Path, PurePosixPath

import pytest

house = Path(__file__).resolve().parents[2]
blocks = house / 'pkg/blocks'
sources = sorted(blocks.rglob('*.[ch]*')) # .hpp, .cpp, and what else the language is written in
includes = lambda path: re.findall(r'^\s*#\s*include\s*([<"][^>"]+[>"])', path.read_text(), re.M)


@pytest.mark.parametrize('path', sorted((blocks / 'kernel').rglob('*.[ch]*')), ids=lambda path: path.name)
def test_kernelKnowsNoYade(path):
	yade = [name for name in includes(path) if re.match(r'["<](core|lib|pkg|py)/|[<"]boost/python|[<"]Python', name)]
	assert not yade and 'namespace yade' not in path.read_text()


def rowsOfFolders():
	"""The table 'Folders' of pkg/blocks/README.md: folder -> what stands in its last column."""
	section = (blocks / 'README.md').read_text().split('\n## Folders\n')[1].split('\n## ')[0]
	rows = re.findall(r'^\| `([^`]+)` \| .* \| ([^|`]+) \|$', section, re.M)
	assert len(rows) == section.count('\n| `'), 'a row is not of the form | `folder` | what | may use |'
	named = {Path(folder).name: folder for folder, _ in rows} # the last column calls folders by their last names
	assert len(named) == len(rows), 'two folders of the same name'
	return {folder: [] if mayUse == 'nothing' else [named[name] for name in mayUse.split(', ')] for folder, mayUse in rows}


def foldersUsedBy(folder, rows):
	"""Itself, those of its row, and those of their rows."""
	found = [folder]
	for one in found: # the list grows while it is gone through
		found += [other for other in rows[one] if other not in found]
	return found


def test_theTableHasNoCycle():
	TopologicalSorter(rowsOfFolders()).prepare() # CycleError where it goes round


def test_everyFolderStandsInTheTable():
	"""Neither a folder without a row nor a row without a folder."""
	assert set(rowsOfFolders()) == {str(path.parent.relative_to(blocks)) for path in sources}


@pytest.mark.parametrize('path', sources, ids=lambda path: str(path.relative_to(blocks)))
def test_includesGoWhereTheTableSays(path):
	"""An include in quotation marks or by another way round (<blocks/views/../...>) is refused too: it leads anywhere."""
	mayUse = foldersUsedBy(str(path.parent.relative_to(blocks)), rowsOfFolders())
	ours = [name for name in includes(path) if name[0] == '"' or 'blocks/' in name]
	assert not [name for name in ours if not (name.startswith('<blocks/') and str(PurePosixPath(name[8:-1]).parent) in mayUse)]


def test_everyModuleStandsInTheTable():
	"""py/README.md: each module and folder of yadeblocks once, and nothing else."""
	rows = re.findall(r'^\| [^|`]+ \| (.*) \|$', (house / 'py/README.md').read_text(), re.M)
	told = re.findall(r'`([\w/]+)`', ' '.join(rows))
	package = house / 'py/yadeblocks'
	modules = [path.stem for path in package.glob('*.py') if path.stem != '__init__'] + [f'{path.parent.name}/' for path in package.glob('*/__init__.py')]
	assert sorted(told) == sorted(modules)


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


def test_breakagesNameTestsThatExist():
	"""Every part of a filter, and every file; what is noticed through one part would hide that another is gone."""
	found = re.findall(r'^TEST(?:_P|_F)?\((\w+),\s*(\w+)\)', '\n'.join(path.read_text() for path in (house / 'tests/kernel').rglob('*.cpp')), re.M)
	kernel, missing = ['.'.join(names) for names in found], []
	for patch in (house / 'tests/breakages').glob('*.patch'):
		kind, what = re.search(r'^Test: (\w+) (.*)$', patch.read_text(), re.M).groups()
		if kind == 'kernel': missing += [(patch.name, part) for part in what.split(':') if not fnmatch.filter(kernel, part)]
		elif not (house / 'tests/yade' / what.split()[0]).exists(): missing.append((patch.name, what))
	assert len(kernel) > 300 and not missing
