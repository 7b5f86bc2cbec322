# yade-blocks, GPL-2.0-or-later
"""YADE's own models as the benchmark runs them, calibrated: that they still do what they were calibrated to do."""
import json
from pathlib import Path

import pytest

from scenes import *

scripts = Path(differences.__code__.co_filename).parents[2] / 'scripts'


def quantities(folder, name, *words):
	run = runYade(scripts / (name + '.py'), *words, 'tag=t', cwd=folder)
	assert run.returncode == 0, (run.stdout + run.stderr)[-3000:]
	result = json.loads((Path(folder) / 'out' / (name + '-t') / 'result.json').read_text())
	assert result['quality']['without_peak'] == []
	return {q['name']: q['measured'] for q in result['quantities']}


@pytest.mark.parametrize('model', ['jcfpm', 'jcfpmSmooth', 'cohfrict', 'cpm', 'lourenco'])
def test_spheresInTension(tmp_path, model):
	found = quantities(tmp_path, 'spheres', 'experiment=tension', 'model=' + model, 'steps=10000')
	# calibrated to 3 % of the means of three packings; single ones differ by up to 15 %, half the steps add up to 10 % to the peak
	assert found['peak_tensile_stress'] == pytest.approx(0.35, rel=0.3) and found['joint_stiffness'] == pytest.approx(50, rel=0.2)


def test_polyhedraInTension(tmp_path):
	found = quantities(tmp_path, 'polyhedra', 'experiment=tension', 'steps=5000')
	assert found['peak_tensile_stress'] == pytest.approx(0.35, rel=0.15) and found['joint_stiffness'] == pytest.approx(50, rel=0.15)


@pytest.mark.parametrize(
	'words, said', [(('spheres', 'model=wood'), 'model'), (('polyhedra', 'experiment=compression'), 'experiment'), (('polyhedra', 'steps=-1'), 'steps')]
)
def test_wrongInput(tmp_path, words, said):
	run = runYade(scripts / (words[0] + '.py'), *words[1:], cwd=tmp_path)
	assert run.returncode and words[0] + '.' + said in run.stdout + run.stderr
