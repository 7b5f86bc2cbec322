# yade-blocks, GPL-2.0-or-later
"""Cases with an exact answer: each says theory and what was computed; scripts/verification.sh prints the table."""
import json
import time
from pathlib import Path

import pytest


def pytest_addoption(parser):
	parser.addoption('--case', default='quick', help='all, quick (those of some seconds together) or the name of one test')
	parser.addoption('--report', default='', help='folder for table.md and result.json')


def pytest_configure(config):
	config.addinivalue_line('markers', 'slow: not in CI')
	config.rows = []


def pytest_collection_modifyitems(config, items):
	wanted = config.getoption('--case')
	chosen = [item for item in items if wanted == 'all' or wanted == 'quick' and not item.get_closest_marker('slow') or wanted == item.originalname[5:]]
	if not chosen:
		names = sorted({item.originalname[5:] for item in items})
		pytest.exit('case must be all, quick or one of %s; got %s' % (', '.join(names), wanted), 2)
	items[:] = chosen


class Compare:
	"""Theory beside what was computed, row by row; a row that is further off than it may be fails the case when it is over."""
	def __init__(self, rows):
		self.rows, self.start, self.failed = rows, time.process_time(), []

	def __call__(self, what, theory, computed, tolerance, source):
		"""tolerance: of the relative error. source: of the theory."""
		theory, computed = float(theory), float(computed)
		error = computed / theory - 1
		cpu = time.process_time() - self.start
		self.rows.append(
			dict(
				case=what, theory=theory, computed=computed, error=error, allowed=tolerance, source=source, cpu_s=cpu,
				passed=abs(error) <= tolerance
			)
		)
		if not abs(error) <= tolerance:
			self.failed.append('%s: %.6g instead of %.6g, error %.1e, allowed %.1e' % (what, computed, theory, error, tolerance))
		self.start = time.process_time()


@pytest.fixture
def compare(request):
	what = Compare(request.config.rows)
	yield what
	assert not what.failed, '; '.join(what.failed)


def pytest_terminal_summary(terminalreporter, config):
	if not config.getoption('--report') or not config.rows: return
	lines = ['| case | theory | computed | error | allowed | CPU s | source |', '|---|---|---|---|---|---|---|']
	lines += [
		'| %s | %.6g | %.6g | %s%.1e%s | %.0e | %.2f | %s |' % (
			row['case'], row['theory'], row['computed'], '' if row['passed'] else '**', row['error'], '' if row['passed'] else '**', row['allowed'],
			row['cpu_s'], row['source']
		) for row in config.rows
	]
	for line in ['', *lines]:
		terminalreporter.write_line(line)
	folder = Path(config.getoption('--report'))
	folder.mkdir(parents=True, exist_ok=True)
	(folder / 'table.md').write_text('\n'.join(lines) + '\n')
	(folder / 'result.json').write_text(json.dumps({'scenario': 'verification', 'cases': config.rows}, indent='\t') + '\n')
