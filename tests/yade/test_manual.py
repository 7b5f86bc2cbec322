# yade-blocks, GPL-2.0-or-later
"""The manual: every Python block runs, page by page; every command names a scenario and keys that exist; its own links and docstrings are whole."""
import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from scenes import *

house = Path(__file__).resolve().parents[2]
pages = sorted((house / 'py/manual').glob('*.rst'))


def blocks(page, language):
	"""The code blocks of a page, in order."""
	found = re.findall(r'^\.\. code-block:: (\w+)\n\n((?:   .*\n|\n)+)', page.read_text(), re.M)
	return [textwrap.dedent(text) for name, text in found if name == language]


@pytest.mark.parametrize('page', [page for page in pages if blocks(page, 'python')], ids=lambda page: page.stem)
def test_blocksRun(page, tmp_path, monkeypatch):
	O.reset()
	monkeypatch.chdir(tmp_path)
	script = tmp_path / f'{page.stem}.py'
	script.write_text('\n'.join(blocks(page, 'python')))
	monkeypatch.setattr(sys, 'argv', [str(script)])
	exec(compile(script.read_text(), str(script), 'exec'), {'__name__': 'manual'})


def test_thereAreBlocks():
	assert sum(len(blocks(page, 'python')) for page in pages) >= 12
	assert not any(language not in ('python', 'sh') for page in pages for language in re.findall(r'code-block:: (\w+)', page.read_text()))


def test_commandsExist():
	lines = [line.split() for page in pages for block in blocks(page, 'sh') for line in block.splitlines() if line.strip()]
	scripts = sorted({house / 'scripts' / f'{words[1]}.py' for words in lines if words[0] == 'scripts/run.sh' and len(words) > 1})
	assert lines and all((house / words[0]).exists() for words in lines) and all(script.exists() for script in scripts)
	run = subprocess.run(['/usr/bin/python3', '-m', 'yadeblocks.help', *scripts], capture_output=True, text=True,
				env={**os.environ, 'PYTHONPATH': str(house / 'py')})
	parts = re.findall(r'^scripts/run.sh (\w+)(.*?)(?=^scripts/run|\Z)', run.stdout, re.M | re.S)
	keys = {name: set(re.findall(r'^  (\w+)=', part, re.M)) for name, part in parts}
	for words in lines:
		assert all(word == 'help' or word.partition('=')[0] in keys[words[1]] for word in words[2:]), words


def test_pagesAreListed():
	listed = re.findall(r'^   (\w+)$', (house / 'py/manual/index.rst').read_text(), re.M)
	assert sorted(listed) == sorted(page.stem for page in pages if page.stem != 'index')


def test_classPages(tmp_path):
	"""No role of YADE's is left, every method and attribute of our classes has words, and links lead to pages that exist."""
	sys.path.insert(0, str(house / 'py/manual'))
	import classes
	classes.write(tmp_path)
	written = {page.stem: page.read_text() for page in tmp_path.glob('*.rst')}
	assert set(written) == {*classes.names, 'index'} and 'addVoronoi(outline, material, size' in written['BlockModel']
	for name, text in written.items():
		assert not re.search(r':y\w+:', text), name
		assert all(target in written for target in re.findall(r':doc:`[^`]*<(\w+)>`', text)), name
	assert 'Normal stiffness JKn [Pa/m].' in written['JointMat'] and 'Default: ``0``' in written['JointMat']
