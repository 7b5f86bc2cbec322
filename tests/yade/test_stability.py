# yade-blocks, GPL-2.0-or-later
"""The cases of scripts/stability.py that take less than a second, and what becomes of a wrong name. The whole list: scripts/stability.sh."""
import json

import pytest

from scenes import *

script = os.path.join(os.path.dirname(os.path.abspath(differences.__code__.co_filename)), '..', '..', 'scripts', 'stability.py')


@pytest.fixture(scope='module')
def report(tmp_path_factory):
	folder = tmp_path_factory.mktemp('stability')
	process = runYade(script, 'case=quick', cwd=folder)
	assert (folder / 'out/stability/result.json').exists(), process.stderr
	return process, json.loads((folder / 'out/stability/result.json').read_text()), (folder / 'out/stability/table.md').read_text()


def test_allPass(report):
	process, result, table = report
	assert result['failed'] == [] and process.returncode == 0, table
	assert len(result['cases']) >= 20 and all(case['seen'] for case in result['cases'])
	assert all(case['energy_error'] is None or case['energy_error'] < 0.01 for case in result['cases'])


def test_everyCaseHasItsRow(report):
	_, result, table = report
	rows = table.splitlines()[2:]
	assert [row.split(' | ')[0].lstrip('| ') for row in rows] == [case['case'] for case in result['cases']]


def test_unknownCase(tmp_path):
	process = runYade(script, 'case=nonsense', cwd=tmp_path)
	assert process.returncode == 2 and 'stability.case must be all, quick or one of' in process.stderr and 'got nonsense' in process.stderr
