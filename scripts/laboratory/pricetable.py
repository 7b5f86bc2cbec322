# yade-blocks, GPL-2.0-or-later
"""What features cost a step, as a table."""
import json
import re

import numpy as np

from .features import features
from .instructions import readProfiles, sourceLines


def report(folder, rows, window, house):
	"""table.md and price.csv of what has been measured in a folder, printed, too. rows: of switches.rowsOf; window: steps."""
	lines, table = [], []
	source = sourceLines(house)
	for scene in ('tension', 'compression', 'crushed'):
		read = lambda kind: json.loads((folder / ('%s.%s.json' % (scene, kind))).read_text())
		sizes, turns, profiles = read('sizes'), read('times'), readProfiles(folder / (scene + '.callgrind'))
		once = float(np.median(turns['bare']))
		bare = profiles['bare']
		off = bare.total / window
		lines += [
			'',
			'## %s' % scene, '', ', '.join('%d %s' % (value, name) for name, value in sizes.items()) + '.', '',
			'Bare: %s thousand instructions, %.0f µs a step; counted again: %+.4f %%.' %
			(_kilo(off), once / 1e3, 100 * (profiles['bare again'].total / bare.total - 1)), '',
			'| feature | instructions a step, on (10³) | more than bare | | µs more |', '|---|---:|---:|---:|---:|'
		]
		for row in rows:
			if row.name not in profiles: continue
			more, slower = row.share * (profiles[row.name].total / window -
							off), row.share * float(np.median(np.subtract(turns[row.name], turns['bare'])))
			lines.append('| %s | %s | %+.1f | %+.1f %% | %+.1f |' % (row.name, _kilo(off + more), more / 1e3, 100 * more / off, slower / 1e3))
			table.append((scene, row.name, off, off + more, once, once + slower))
		if (folder / (scene + '.threads.json')).exists():
			clock = read('threads')
			lines.append(
				'| two threads instead of one (wall-clock) | | | %+.0f %% | %+.1f |' %
				(100 * (clock['2'] / clock['1'] - 1), (clock['2'] - clock['1']) / 1e3)
			)
		if scene != 'crushed':
			lines += ['', '| switched off | instructions a step | share of the bare step |', '|---|---:|---:|']
			for name, feature in features.items():
				count = bare.inFeature(feature, source) / window
				lines.append('| %s | %.0f | %.2f %% |' % (name, count, 100 * count / off))
				table.append((scene, name + ', off', off - count, off, '', ''))
		lines += ['', '| where the bare step goes | share |', '|---|---:|']
		lines += ['| %s | %.1f %% |' % (_short(name), 100 * count / bare.total) for name, count in bare.byFunction().most_common(12)]
	(folder / 'table.md').write_text('\n'.join(lines[1:]) + '\n')
	with open(folder / 'price.csv', 'w') as csv:
		csv.write('scene,feature,instructions_without,instructions_with,ns_without,ns_with\n')
		for row in table:
			csv.write(','.join('"%s"' % cell if isinstance(cell, str) else '%.6g' % cell for cell in row) + '\n')
	print('\n'.join(lines))


def _kilo(instructions):
	return '%.1f' % (instructions / 1e3)


def _short(function):
	"""A C++ function's name without arguments and namespaces; code of libraries without symbols is an address."""
	name = re.sub(r'\(anonymous namespace\)::|blocks::|yade::|std::|boost::', '', function)
	return 'a library' if name.startswith('0x') else re.sub(r'\(.*|<.*', '', name).split(' ')[-1].strip("'").strip() or function[:40]
