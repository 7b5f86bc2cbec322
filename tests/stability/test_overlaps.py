# yade-blocks, GPL-2.0-or-later
"""Joints and contacts that are pressed too deep."""
import pytest

from looks import *


def press(look, contact, overlaps, kn=young / 2):
	"""Loads a block upon another until they overlap by so much [m], one overlap after the other; what was said meanwhile, and the outcomes."""
	begin()
	model = column([0.1, 0.1], width=0.1, zoneSize=0.05)
	lower, upper = range(model.firstNode[1]), range(model.firstNode[1], model.firstNode[2])
	model.drive('low', lower, 'xy')
	model.drive('sides', upper, 'x')
	model.push('load', upper, 'y', force=0)
	model.insert()
	O.dt, O.engines = 1, engines(joints(kn, bonded=not contact), contact=contact, alpha=0.5)
	texts, ends, before = [], [], 0

	def load(overlap):
		for share in np.linspace(0, 1, 21)[1:]: # little by little: a sudden load would press twice as deep
			model.setTarget('load', -kn * 0.1 * (before + share * (overlap - before)))
			for _ in range(100):
				O.step()
			if overlap != overlaps[-1]: look.balance() # the last one is not to be computed

	for overlap in overlaps:
		with messages() as text:
			ends.append(outcome(lambda: load(overlap)))
		texts += text
		before = overlap
	return texts, ends


# Squares of 0.1 m, zones of 0.05 m: 10 % is 0.005 m. A free contact of such squares pushes with at most kn x 0.008 m; a greater load
# drives one through the other.
@pytest.mark.parametrize(
	'of, contact, overlaps, expected, stopped',
	[('joints', False, [0.002, 0.003, 0.0045, 0.0055], 'one warning with blocks and numbers up to 10 %, refused beyond', 'joints overlap by'),
		(
			'free contacts', True, [0.002, 0.003, 0.007, 0.011
						], 'one warning with blocks and numbers, refused where contact would be lost', 'has gone into block'
		)]
)
@case('precompression of {of}', 'quiet at 4 % of a zone, {expected}')
def test_precompression(look, of, contact, overlaps, expected, stopped):
	(quiet, warned, again, _), ends = press(look, contact, overlaps)
	look.true('overlap' not in quiet and ends[0][0] == 'silent', 'quiet at 4 %')
	look.true(warned.count('overlap') == 1 and 'blocks 0 and 1' in warned and ends[1][0] == 'silent', 'warned: "%s"' % warned.strip().split(': ', 3)[-1])
	look.true('overlap' not in again and ends[2][0] == 'silent', 'only once')
	look.true(ends[3][0] == 'detected' and stopped in ends[3][1], 'stopped: "%s"' % ends[3][1].split(';')[0])


@case('contact too soft', 'a block that would go through another unseen is refused')
def test_tooSoft(look):
	collision(kn=1e9, velocity=100)
	found, message = outcome(lambda: look.run(4000, samples=400))
	look.true(found == 'detected' and 'has gone into block' in message, 'stopped: "%s"' % message.split(';')[0])
