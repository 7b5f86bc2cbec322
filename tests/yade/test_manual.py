# yade-blocks, GPL-2.0-or-later
"""The manual: every example runs; all code is theirs, or a command that exists; formulas can be drawn; links lead somewhere; docstrings are whole."""
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

import matplotlib.image
import pytest

from scenes import *
from yadeblocks import help

house = Path(__file__).resolve().parents[2]
pages = sorted((house / 'py/manual').glob('*.md'))
examples = sorted((house / 'scripts/examples').glob('*.py'))
sys.path.insert(0, str(house / 'py/manual'))


def blocks(page, language):
	"""The code blocks of a page in this language (sh, {literalinclude}, ...), in order: what stands behind the name, and the lines."""
	return [(words.strip(), body) for name, words, body in re.findall(r'^```(\S*) ?(.*)\n((?:.*\n)*?)```$', page.read_text(), re.M) if name == language]


@pytest.mark.parametrize('example', examples, ids=lambda path: path.stem)
def test_examplesRun(example, tmp_path, monkeypatch):
	O.reset()
	monkeypatch.chdir(tmp_path)
	monkeypatch.setattr(sys, 'argv', [str(example)])
	exec(compile(example.read_text(), str(example), 'exec'), {'__name__': 'example'})
	assert {path.name for path in tmp_path.iterdir()} <= {'out'} # nothing beside it, where run.sh starts them: in the house itself
	if example.stem == 'first': leftByTheFirst(tmp_path / 'out/first')


def leftByTheFirst(folder):
	"""A curve with names on its axes, a picture, frames for ParaView."""
	assert {path.name for path in folder.iterdir()} >= {'curve.csv', 'curve.png', 'cracks.png', 'blocks.pvd', 'joints.pvd'}
	assert (folder / 'curve.csv').read_text().startswith('seed,shortening_mm,stress_MPa,broken\n')
	assert all(min(matplotlib.image.imread(folder / name).shape[:2]) > 500 for name in ('curve.png', 'cracks.png'))
	assert (folder / 'blocks.pvd').read_text().count('<DataSet') >= 5


def test_examplesAreShortAndShown():
	"""All are in the manual, and all code of the manual is theirs."""
	shown = [words for page in pages for words, _ in blocks(page, '{literalinclude}')]
	assert sorted(shown) == sorted(f'examples/{path.name}' for path in examples)
	assert all(len(path.read_text().splitlines()) <= 65 for path in examples)
	fences = [line for page in pages for line in page.read_text().splitlines() if line.startswith('```')]
	assert {line.split()[0] for line in fences[::2]} <= {'```sh', '```{literalinclude}', '```{toctree}'} and set(fences[1::2]) == {'```'}


#: What makes a command of the manual short: keys in place of its own, or besides them.
shorter = {
	'wall': 'steps=1000 stroke=5e-5 crack=false', 'drywall': 'precision=0.09 most=20000', 'arch': 'precision=0.09', 'tension': 'steps=2000',
	'compression': 'steps=1000 unitSize=0.02 mortarSize=0.006', 'shear': 'steps=2000'
}
#: What is run elsewhere: by ctest itself, by test_help, by test_studies (with runs that a stand-in answers).
elsewhere = ('scripts/test.sh', 'scripts/verification.sh', 'scripts/study.sh', 'scripts/run.sh')


def commands():
	"""The scenarios that the manual and the README start, with their keys."""
	for page in (*pages, house / 'README.md'):
		for _, block in blocks(page, 'sh'):
			for line in block.splitlines():
				words = line.partition('#')[0].split()
				if not words or words[0] in elsewhere and len(words) == 1 or words[0] == 'scripts/study.sh': continue
				assert words[0] == 'scripts/run.sh', line
				yield words[1:]


given = sorted({tuple(words) for words in commands() if not words[0].startswith('examples/')})


def test_commandsExist():
	lines = [line.split() for page in (*pages, house / 'README.md') for _, block in blocks(page, 'sh') for line in block.splitlines() if line.strip()]
	lines = [words for words in (words[:words.index('#')] if '#' in words else words for words in lines) if words]
	scripts = sorted({house / 'scripts' / f'{words[1]}.py' for words in lines if words[0] == 'scripts/run.sh' and len(words) > 1})
	assert len(lines) > 15 and all((house / words[0]).exists() for words in lines) and all(script.exists() for script in scripts)
	run = subprocess.run(['/usr/bin/python3', '-m', 'yadeblocks.help', *scripts], capture_output=True, text=True,
				env={**os.environ, 'PYTHONPATH': str(house / 'py')})
	parts = re.findall(r'^scripts/run.sh (\w+)(.*?)(?=^scripts/run|\Z)', run.stdout, re.M | re.S)
	keys = {name: set(re.findall(r'^  (\w+)=', part, re.M)) for name, part in parts}
	for words in lines:
		if words[0] != 'scripts/run.sh': continue
		assert all(word == 'help' or word.partition('=')[0] in keys[Path(words[1]).name] for word in words[2:]), words


def test_nothingOfAPageIsTakenForAComment():
	"""MyST leaves out what begins with %; a wrapped '-1 %' did, and took half a sentence along."""
	assert [(page.name, line) for page in pages for line in page.read_text().splitlines() if line.lstrip().startswith('%')] == []


def test_pagesAreListed():
	listed = [line for _, block in blocks(house / 'py/manual/index.md', '{toctree}') for line in block.splitlines() if line and line[0] != ':']
	assert sorted(listed) == sorted(['classes/index', *(page.stem for page in pages if page.stem != 'index')])


def test_linksOfPagesAndReadme(tmp_path):
	"""Each leads to a file, in the house or as made by figures.py and classes.py."""
	import classes
	import figures
	figures.write(tmp_path / 'figures'), classes.write(tmp_path / 'classes')
	for page in (*pages, house / 'README.md', house / 'pkg/blocks/README.md', house / 'tests/README.md'):
		for target in re.findall(r'\]\(([^)#\s]+)\)', re.sub(r'`[^`\n]*`', '', page.read_text())):
			if not target.startswith('http'):
				assert any((place / unquote(target)).exists() for place in (page.parent, tmp_path)), (page.name, target)


def test_builds(tmp_path):
	"""Without a warning, all links whole, nothing fetched from elsewhere; formulas and figures are in it."""
	import classes
	import figures
	import links
	source, built = tmp_path / 'source', tmp_path / 'html'
	shutil.copytree(house / 'py/manual', source, ignore=shutil.ignore_patterns('__pycache__'))
	shutil.copytree(house / 'scripts/examples', source / 'examples', ignore=shutil.ignore_patterns('__pycache__'))
	figures.write(source / 'figures'), classes.write(source / 'classes')
	run = subprocess.run(['/usr/bin/python3', '-m', 'sphinx', '-q', '-W', '--keep-going', '-b', 'html', source, built], capture_output=True, text=True)
	assert run.returncode == 0, run.stderr
	assert links.broken(built) == []
	assert '_static/custom.css' in (built / 'walls.html').read_text() and 'pre-wrap' in (built / '_static/custom.css').read_text() # no code is cut off
	theory = (built / 'theory.html').read_text()
	assert theory.count('class="formula"') >= 7 and theory.count('<img') >= 3 and '$' not in re.sub(r'<svg.*?</svg>', '', theory, flags=re.S)


def test_formulasCanBeDrawn():
	"""Offline, by matplotlib: what it cannot draw must not get into the manual."""
	import mathsvg
	formulas = [formula for page in pages for formula in re.findall(r'\$\$(.+?)\$\$|\$([^$]+?)\$', page.read_text(), re.S)]
	assert len(formulas) > 20
	for both in formulas:
		assert '<path' in mathsvg.svg(''.join(both))
	with pytest.raises(ValueError):
		mathsvg.svg(r'\nosuchthing{x}')


def test_brokenLinksAreSeen(tmp_path):
	import links
	(tmp_path / 'a.html').write_text('<link href="https://x.org/a.css"><p id="here"><a href="#here">a</a><a href="b.html#p">b</a><img src="no.png">')
	(tmp_path / 'b.html').write_text('<a href="https://x.org">out</a><a href="a.html#there">c</a>')
	assert sorted(links.broken(tmp_path)) == [
		'a.html: b.html#p', 'a.html: https://x.org/a.css is fetched from elsewhere', 'a.html: no.png', 'b.html: a.html#there'
	]


def test_classPages(tmp_path):
	"""No role of YADE's is left, every method and attribute of our classes has words, and links lead to pages that exist."""
	import classes
	classes.write(tmp_path)
	written = {page.stem: page.read_text() for page in tmp_path.glob('*.rst')}
	assert set(written) == {*classes.names, 'index'} and 'addVoronoi(outline, material, size' in written['BlockModel']
	assert 'What :doc:`BlockIntegrator` has, it has, too.' in written['BlockMotion'] and ' it has, too' not in written['BlockModel']
	for name, text in written.items():
		assert not re.search(r':y\w+:', text), name
		assert all(target in written for target in re.findall(r':doc:`[^`]*<(\w+)>`', text)), name
	assert 'Normal stiffness JKn [Pa/m].' in written['JointMat'] and 'Default: ``0``' in written['JointMat']


@pytest.mark.parametrize('words', given, ids=' '.join)
def test_commandsRun(words, tmp_path, monkeypatch, capsys):
	"""Each scenario that a page starts, with the page's keys; some others make it short."""
	name, *keys = words
	if 'help' in keys: # as scripts/run.sh does
		help.explain(house / f'scripts/{name}.py')
		assert f'scripts/run.sh {name} [key=value ...]' in capsys.readouterr().out
		return
	own = [word for word in keys if not word.endswith('.json')] # a file that a study leaves
	more = [
		word for word in f'{shorter.get(name, "")} vtk=false sheets=false'.split()
		if word.partition('=')[0] not in {key.partition('=')[0] for key in own}
	]
	script = house / f'scripts/{name}.py'
	known = re.findall(r"'?(vtk|sheets)'?\b", script.read_text())
	monkeypatch.chdir(tmp_path)
	monkeypatch.setattr(
		sys, 'argv',
		[str(script), *own, *(word for word in more if word.partition('=')[0] not in ('vtk', 'sheets') or word.partition('=')[0] in known)]
	)
	O.reset()
	with pytest.MonkeyPatch.context() as patch:
		patch.syspath_prepend(str(script.parent))
		exec(compile(script.read_text(), str(script), 'exec'), {'__name__': '__main__', '__file__': str(script)})
	assert json.loads((tmp_path / 'out' / name / 'result.json').read_text())['complete']
