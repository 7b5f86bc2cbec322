# yade-blocks, GPL-2.0-or-later
"""Stability cases: which are run, when one has passed, and the report that scripts/stability.sh prints and keeps."""
import json
import time
from pathlib import Path

import pytest


def pytest_addoption(parser):
	parser.addoption('--case', default='all', help='all, quick (those of less than a second), list (names only) or the name of one')
	parser.addoption('--report', default='', help='folder for table.md and result.json')


def pytest_configure(config):
	config.addinivalue_line('markers', 'case(name, expected, slow): a stability case')
	config.entries = []


def named(item):
	"""Name, expectation and slowness of a case."""
	name, expected, slow = item.get_closest_marker('case').args
	parameters = item.callspec.params if hasattr(item, 'callspec') else {}
	return name.format(**parameters), expected.format(**parameters), slow


def pytest_collection_modifyitems(config, items):
	wanted = config.getoption('--case')
	names = [named(item)[0] for item in items]
	if wanted == 'list':
		print(*names, sep='\n')
		pytest.exit('these are all', 0)
	if wanted not in ('all', 'quick', *names): pytest.exit('stability.case must be all, quick or one of: %s; got %s' % (', '.join(names), wanted), 2)
	items[:] = [item for item in items if wanted == 'all' or wanted == 'quick' and not named(item)[2] or wanted == named(item)[0]]


@pytest.fixture
def look():
	"""What the case saw."""
	from looks import Look
	return Look()


@pytest.hookimpl(hookwrapper=True)
def pytest_pyfunc_call(pyfuncitem):
	"""A case that cannot even be run has failed; so has one whose energy does not balance, or that saw something else than expected."""
	look, start, config = pyfuncitem.funcargs['look'], time.process_time(), pyfuncitem.config
	outcome = yield
	if outcome.excinfo: look.true(False, '%s: %s' % (outcome.excinfo[0].__name__, outcome.excinfo[1]))
	look.forget()
	if look.energyError is not None and not look.energyError <= look.energyLimit: look.true(False, 'energy does not balance')
	name, expected, _ = named(pyfuncitem)
	entry = {
		'case': name, 'expected': expected, 'seen': look.sentences, 'energy_error': look.energyError, 'steps': look.steps,
		'cpu_s': time.process_time() - start, 'passed': look.passed
	}
	config.entries.append(entry)
	if not look.passed: # pluggy 1.0, Debian's, has no public name for this
		outcome._excinfo = AssertionError, AssertionError('\n'.join(look.sentences)), None


def pytest_report_teststatus(report, config):
	if not config.getoption('--report') or report.when != 'call': return None
	entry = config.entries[-1]
	balance = 'none' if entry['energy_error'] is None else '%.1e' % entry['energy_error']
	return report.outcome, '%-4s %-36s %5.1f s  energy %s\n' % ('ok' if entry['passed'] else 'FAIL', entry['case'], entry['cpu_s'], balance), ''


def shown(entry):
	balance = '' if entry['energy_error'] is None else '%.1e' % entry['energy_error']
	return '| %s | %s | %s | %s | %s |' % (entry['case'], entry['expected'], '; '.join(entry['seen']), balance, 'pass' if entry['passed'] else '**FAIL**')


def pytest_terminal_summary(terminalreporter, config):
	if not config.getoption('--report') or not config.entries: return
	failed = [entry['case'] for entry in config.entries if not entry['passed']]
	lines = ['| case | expected | seen | energy error | |', '|---|---|---|---|---|'] + [shown(entry) for entry in config.entries]
	for line in ['', *lines]:
		terminalreporter.write_line(line)
	folder = Path(config.getoption('--report'))
	folder.mkdir(parents=True, exist_ok=True)
	(folder / 'table.md').write_text('\n'.join(lines) + '\n')
	(folder / 'result.json').write_text(json.dumps({'scenario': 'stability', 'cases': config.entries, 'failed': failed}, indent='\t') + '\n')
	passed = len(config.entries) - len(failed)
	terminalreporter.write_line('\n%d of %d cases passed%s' % (passed, len(config.entries), ': failed ' + ', '.join(failed) if failed else ''))
