# yade-blocks, GPL-2.0-or-later
"""Very small, very large, one block, ten thousand."""
import time

from looks import *


def couplet(look, scale):
	"""Peak stress and broken points of a small couplet in tension, all lengths times `scale`."""
	look.forget()
	begin(unit=dict(young=16.7e9, poisson=0.2, density=1900), mortar=dict(young=3e9, poisson=0.2, density=1250))
	box = lambda *corners: rectangle(*(scale * c for c in corners))
	model = BlockModel(thickness=0.05 * scale)
	model.addVoronoi(box(0, 0.01, 0.04, 0.02), 'mortar', size=6e-3 * scale, seed=3)
	model.addRegion(box(0, 0, 0.04, 0.01), 'unit', zoneSize=5e-3 * scale)
	model.addRegion(box(0, 0.02, 0.04, 0.03), 'unit', zoneSize=5e-3 * scale)
	model.bond()
	model.drive('low', level(model, 0), 'xy')
	model.drive('top', level(model, 0.03 * scale), 'y', velocity=8e-6 * scale, rampTime=0.075)
	model.insert()
	O.dt = 1.5 / 3000
	O.engines = engines(joints(400e9 / scale, labels=('unit', 'mortar'), cohesion=0.6e6, tension=0.6e6, frictionAngle=0.66, dilationAngle=0.07))
	stress = []
	for _ in range(300):
		look.run(10, samples=1)
		stress.append(model.groupForce('top') / (0.04 * 0.05 * scale**2))
	return max(stress), np.count_nonzero(model.pointStatus), np.array(stress)


@case('micrometre and kilometre', 'stresses and cracks of a couplet of 40 mm, to the last bit')
def test_sizes(look):
	peak, broken, curve = couplet(look, 1)
	look.sentences.append('40 mm: peak %.6g Pa, %d points broken' % (peak, broken))
	for name, scale in ('1.2 um', 2.0**-15), ('1.3 km', 2.0**15): # powers of two are rounded alike
		other, cracks, stress = couplet(look, scale)
		look.true((stress == curve).all() and cracks == broken, '%s: the same' % name)


@case('single block', 'falls as bodies fall; carries its weight')
def test_single(look):
	begin(rock=dict(poisson=0.2))
	model = column([0.2], zoneSize=0.1)
	model.gravity((0, -g))
	model.insert()
	O.engines = engines([], dynamic, damping='none')
	look.run(1000)
	# v = 0 half a step before the start: after n steps x = g dt^2 n (n + 1)/2; a coordinate of 0.2 m is rounded 1000 times
	fallen = (model.reference - model.position)[:, 1]
	look.equal('fallen [m]', fallen.mean(), g * O.dt**2 * 1000 * 1001 / 2, 1000 * eps * 0.2 / fallen.mean())
	look.forget()
	begin(rock=dict(poisson=0.2))
	model = column([0.2], zoneSize=0.1)
	model.drive('low', level(model, 0), 'xy')
	model.gravity((0, -g))
	model.insert()
	O.dt, O.engines = 1e-3, engines([], alpha=0.5)
	look.run(5000)
	look.equal('reaction by weight', model.groupForce('low', axis='y') / (model.mass.sum() * g), 1, 1e-8)


@case('10,000 blocks', 'a block of 1 m pressed together, with the engines of general contact; energy balances', slow=True)
def test_tenThousand(look):
	begin(rock=dict(poisson=0.2))
	start = time.process_time()
	model = BlockModel(thickness=1)
	model.addVoronoi(rectangle(0, 0, 1, 1), 'rock', size=0.01, seed=1, lloyd=1)
	model.bond()
	model.drive('low', level(model, 0), 'y')
	model.drive('top', level(model, 1), 'y', velocity=-1e-6, rampTime=20)
	model.insert()
	built = time.process_time() - start
	O.dt, O.engines = 1, engines(joints(young / 0.01, cohesion=1e6, tension=1e5, frictionAngle=0.6), contact=True)
	start = time.process_time()
	look.run(300, samples=10)
	spent = time.process_time() - start
	look.true(
		abs(model.blockCount - 1e4) < 200,
		'%d blocks, %d zones, built in %.1f s, %.1f ms a step' % (model.blockCount, model.zoneCount, built, spent / 300 * 1e3)
	)
	look.true(np.isfinite(model.position).all(), '%d points broken' % np.count_nonzero(model.pointStatus))
