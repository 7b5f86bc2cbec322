# yade-blocks, GPL-2.0-or-later
"""What the stability watch costs."""
import time

from looks import *


def stepCost(build, watchPeriod, steps):
	"""CPU time of a step [s]: the least of three, alternately measured by the caller."""
	build()
	O.engines[-1].watchPeriod = watchPeriod
	O.trackEnergy = False
	O.run(20, True)
	start = time.process_time()
	O.run(steps, True)
	return (time.process_time() - start) / steps


@case('cost of the watch', 'on by default; a look every 100 steps costs less than 1 % of them', slow=True)
def test_watchCost(look):
	def bonded():
		begin()
		model = panel(size=0.05)
		model.insert()
		O.dt, O.engines = 1, engines(joints(young / 0.05))

	def loose():
		begin()
		model = panel(size=0.05)
		model.drive('low', level(model, 0), 'xy')
		model.gravity((0, -g))
		model.insert()
		O.dt, O.engines = 1e-3, engines(joints(young / 0.05, bonded=False, frictionAngle=0.6), contact=True)

	begin()
	look.true(BlockIntegrator().watchPeriod == 100, 'default watchPeriod %d' % BlockIntegrator().watchPeriod)
	for name, build in ('bonded', bonded), ('free contacts', loose):
		times = np.array([(stepCost(build, 0, 2000), stepCost(build, 1, 2000)) for _ in range(3)]).min(axis=0)
		look.below(
			'%s: a look takes %.2f of a step of %.0f us; share' % (name, times[1] / times[0] - 1, 1e6 * times[0]), (times[1] / times[0] - 1) / 100,
			0.01
		)
