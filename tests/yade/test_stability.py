# yade-blocks, GPL-2.0-or-later
"""The report of the stability cases: what is as expected passes, what is not fails, and so does what cannot be run. The cases: tests/stability."""
import json
import shutil
import sys

import pytest

from scenes import *

tests = os.path.join(os.path.dirname(os.path.abspath(differences.__code__.co_filename)), '..')

cases = """from looks import *

@pytest.mark.parametrize('n', [1, 2])
@case('number {n}', 'is {n}')
def test_number(look, n):
	look.equal('it', n, 1, 0.1)

@case('no energy', 'balances')
def test_energy(look):
	look.first, look.turnover, look.imbalance = 0, 1, 0.5

@case('an error', 'is a failure', slow=True)
def test_error(look):
	look.sentences.append('began')
	1 / 0
"""


@pytest.fixture
def report(tmp_path):
	folder = tmp_path / 'stability'
	shutil.copytree(os.path.join(tests, 'stability'), folder, ignore=lambda _, names: [name for name in names if name.startswith('test_')])
	(folder / 'test_some.py').write_text(cases)

	def run(wanted):
		command = [sys.executable, os.path.join(tests, 'runInYade.py'), folder, '--case=' + wanted, '--report=' + str(tmp_path / 'out')]
		return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)

	run.result = lambda: json.loads((tmp_path / 'out/result.json').read_text())
	run.table = lambda: (tmp_path / 'out/table.md').read_text().splitlines()[2:]
	return run


def test_allCases(report):
	run = report('all')
	assert run.returncode == 1 and report.result()['failed'] == ['number 2', 'no energy', 'an error'], run.stdout + run.stderr
	assert [case['seen'] for case in report.result()['cases']][::3] == [['it 1 (error 0.0e+00, allowed 1.0e-01)'],
										['began', 'ZeroDivisionError: division by zero (!)']]
	assert [row.split(' | ')[0].lstrip('| ') for row in report.table()] == ['number 1', 'number 2', 'no energy', 'an error']
	assert [row.rstrip('| ').split(' | ')[-1] for row in report.table()] == ['pass', '**FAIL**', '**FAIL**', '**FAIL**']
	assert '1 of 4 cases passed: failed number 2, no energy, an error' in run.stdout


@pytest.mark.parametrize('wanted, code, seen', [('quick', 1, 3), ('number 1', 0, 1)])
def test_someCases(report, wanted, code, seen):
	assert report(wanted).returncode == code and len(report.result()['cases']) == seen


def test_unknownCase(report):
	run = report('nonsense')
	said = 'stability.case must be all, quick or one of: number 1, number 2, no energy, an error; got nonsense'
	assert run.returncode == 2 and said in run.stdout + run.stderr
