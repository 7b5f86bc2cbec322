# yade-blocks, GPL-2.0-or-later
"""The path from event to event, told while it is computed."""
import math

from .._door import door
from ..progress import Progress


@door(model='model', group='str', label='str', displacement='float')
def follow(model, group, label='', displacement=math.inf, **options):
	"""`BlockModel.follow` with a progress line, and one at the end that says why the path ends; options go to it. `displacement` is where it ends at the
	latest [m].

	A further column of the path, `cracked`, is the number of broken contact points with the one that stands at its strength and breaks next."""
	seen = [0., 0., 0]

	def look(*now):
		seen[:] = now
		line(int(1000 * now[0] / displacement))

	with Progress(1000, lambda: 'u %.4f mm  force %.4g N  broken %d' % (1e3 * seen[0], seen[1], seen[2]), label=label) as line:
		path = model.follow(group, displacement=displacement, progress=look, **options)
	path['cracked'] = path['broken'] + (path['point'] >= 0)
	top, last = path['force'].max(), path['force'][-1]
	fallen = ', %.2g %% below it' % (100 - 100 * last / top) if 0 < last < top else ''
	why = _askedFor.get(path['ended'], path['ended'])
	print('%s: from event to event, highest force %.4g N; the path ends%s: %s' % (label or group, top, fallen, why), flush=True)
	return path


_askedFor = {
	'drop': 'the force has fallen as far as was asked for', 'displacement': 'as far as was asked for', 'cracks': 'as many cracks as were asked for',
	'stopped': 'stopped'
} # all other ends are sentences
