# yade-blocks, GPL-2.0-or-later
"""Slivers and very short edges."""
from looks import *


@case('sliver of 1e-6', 'springs in series; undamped at safety 0.95 for 20,000 steps the energy stays')
def test_sliver(look):
	seriesAndKick(look, [0.2, 0.2e-6, 0.2], [young] * 3, young / 0.2)


@case('edge of 1e-6', 'areas of joints add up; stress of springs in series; undamped the energy stays', slow=True)
def test_shortEdge(look):
	step = 0.2e-6

	def scene(velocity):
		begin()
		model = BlockModel(thickness=1)
		model.addRegion(rectangle(0, 0, 0.1, 0.2), 'rock', zoneSize=0.1)
		model.addRegion(rectangle(0.1, 0, 0.2, 0.2 + step), 'rock', zoneSize=0.1)
		model.addRegion([(0, 0.2), (0.1, 0.2), (0.1, 0.2 + step), (0.2, 0.2 + step), (0.2, 0.4), (0, 0.4)], 'rock', zoneSize=0.1)
		model.bond()
		model.drive('low', level(model, 0), 'xy')
		model.drive('top', level(model, 0.4), 'y', velocity=velocity, rampTime=velocity and 1)
		model.drive('aside', level(model, 0.4), 'x')
		model.insert()
		return model

	kn = young / 0.2
	model = scene(4e-5 / 1e3)
	look.equal('joint area', 2 * model.segmentArea.sum(), 0.2 + 0.2 + step, 1e-9)
	O.dt, O.engines = 1, engines(joints(kn), alpha=0.5)
	look.run(1000)
	model.setTarget('top', 0)
	unbalanced = settle(look, model, 1e-8)
	# the two halves differ by 1e-6, so that the stress is uniform up to that
	stress = model.groupTravelled('top') / (0.4 / young + 1 / kn)
	look.equal('stress by springs in series', model.groupForce('top') / 0.2, stress, 1e-5 + 10 * unbalanced)
	look.forget()
	model = scene(0)
	kick(model, 1e-4 * step, held=(level(model, 0), level(model, 0.4)))
	O.engines = engines(joints(kn), dict(quasiStatic=False, safety=0.95), damping='none')
	look.run(20000)
