# yade-blocks, GPL-2.0-or-later
"""Structures with a known answer, as their scenarios have it; CI runs them in tests/scenario/test_structures.py."""
import json
import os
import subprocess
from pathlib import Path

import pytest

scripts = Path(os.path.abspath(__file__)).parents[2] / 'scripts'
cases = { # scenario: quantity, allowed error, source
	'rocking': [('quarter_period', 0.01, 'Housner 1963')],
	'arch': [('limit_thickness_ratio', 0.01, 'Milankovitch 1907')],
	'disc': [('centre_stress', 0.01, 'Hondros 1959')],
}


@pytest.mark.slow
@pytest.mark.parametrize('name', list(cases))
def test_scenario(name, compare, tmp_path):
	environment = {**os.environ, 'OMP_WAIT_POLICY': 'passive'}
	environment.pop('OMP_NUM_THREADS', None)
	run = subprocess.run(['yade', '-n', '-x', '-j1', str(scripts / (name + '.py'))], cwd=tmp_path, env=environment, capture_output=True, text=True)
	assert run.returncode == 0, run.stdout + run.stderr
	found = json.loads((tmp_path / 'out' / name / 'result.json').read_text())
	for quantity, allowed, source in cases[name]:
		q = next(q for q in found['quantities'] if q['name'] == quantity)
		compare('scenario %s: %s' % (name, quantity), q['expected'], q['measured'], allowed, source)
		compare.rows[-1]['cpu_s'] = found['cost']['cpu_s']
