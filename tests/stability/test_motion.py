# yade-blocks, GPL-2.0-or-later
"""Impact, spinning, rest, cracks that open and close."""
import math

from looks import *


@case('impact at 100 m/s', 'momentum stays to rounding, they part again, no part of either goes through the other')
def test_impact(look):
	for what, offset in ('face', 0), ('corner', 0.08):
		look.forget()
		model = collision(10 * young / 0.1, 100, offset)
		momentum = lambda: (model.mass[:, None] * model.velocity).sum(axis=0)
		spin = lambda: (model.mass * (model.position[:, 0] * model.velocity[:, 1] - model.position[:, 1] * model.velocity[:, 0])).sum()
		before, turning = momentum(), spin()
		look.run(4000)
		left, right = slice(model.firstNode[0], model.firstNode[1]), slice(model.firstNode[1], model.firstNode[2])
		mean = lambda block: (model.mass[block] * model.velocity[block, 0]).sum() / model.mass[block].sum()
		# 4000 steps, each with a few roundings of forces that sum to zero
		look.below('momentum lost (%s)' % what, abs(momentum() - before).max() / before[0], 4000 * 10 * eps)
		look.below('angular momentum lost', abs(spin() - turning) / (before[0] * 0.1), 4000 * 10 * eps)
		look.true(mean(right) > mean(left), 'part with %.1f m/s' % (mean(right) - mean(left)))


@case('spinning blocks', '1000 turns: angular momentum to rounding; when stopped no stress is left', slow=True)
def test_spinning(look):
	begin(rock=dict(poisson=0.2))
	model = column([0.1, 0.1], width=0.2, zoneSize=0.1)
	model.insert()
	O.engines = engines(joints(10 * young / 0.1), dict(quasiStatic=False, safety=0.7), damping='none')
	centre = np.array([0.1, 0.1])
	speed = 100.0 # at the rim; c is 3300 m/s, strains are (v/c)^2 = 1e-3
	rate = speed / 0.14
	away = model.position - centre
	model.velocity[:] = rate * np.stack([-away[:, 1], away[:, 0]], axis=1)
	spin = lambda: (model.mass * (model.position[:, 0] * model.velocity[:, 1] - model.position[:, 1] * model.velocity[:, 0])).sum()
	O.step()
	before, steps = spin(), int(1000 * 2 * math.pi / rate / O.dt)
	look.run(steps, samples=100)
	look.below('angular momentum lost', abs(spin() / before - 1), steps * eps)
	elastic = energy('Zones') + energy('Joints')
	look.balance()
	look.forget()
	model.velocity[:] = 0
	O.engines[-1].damping, O.engines[-1].alpha = 'local', 0.5
	for _ in range(20000):
		O.step()
	# what is left is rounding: strains of eps x some nodes x turned components against 1e-3, their square; 1e6 steps of it
	look.below('elastic energy left when stopped, by that of spinning', (energy('Zones') + energy('Joints')) / elastic, 1e-12)
	look.sentences.append('%d steps' % steps)


@case('1e6 steps at rest', 'nothing moves but by rounding; a dry block on a slope of half its friction does not creep', slow=True)
def test_atRest(look):
	for what in 'bonded', 'dry':
		look.forget()
		begin()
		model = column([0.1, 0.1], width=0.1, zoneSize=0.1)
		model.drive('low', level(model, 0) if what == 'bonded' else range(model.firstNode[1]), 'xy')
		model.gravity((0.25 * g, -g))
		model.insert()
		O.dt, O.engines = 1e-3, engines(joints(young / 0.1, frictionAngle=math.atan(0.5), bonded=what == 'bonded'), contact=what == 'dry', alpha=0.3)
		look.run(20000)
		before = np.array(model.position)
		O.run(1000000, True)
		look.balance()
		look.steps += 1000000
		# at worst one rounding of a coordinate a step, all in the same direction
		look.below('moved (%s) [m]' % what, abs(model.position - before).max(), 1e6 * eps * 0.2)
		look.below('kinetic by elastic energy', energy('Kinetic') / (energy('Zones') + energy('Joints')), 1e-12)


@case('crack opened and closed 100 times', 'as stiff at every closing as the springs in series; dissipation never falls', slow=True)
def test_reclosing(look):
	for contact in False, True:
		look.forget()
		begin()
		model = column([0.1, 0.1], width=0.1, zoneSize=0.1)
		model.drive('low', level(model, 0), 'xy')
		model.drive('top', level(model, 0.2), 'y')
		model.drive('aside', level(model, 0.2), 'x')
		model.insert()
		kn, stroke, steps = young / 0.1, 2e-5, 1000
		O.dt, O.engines = 1, engines(joints(kn, cohesion=1e6, tension=1e6, frictionAngle=0.6), contact=contact, alpha=0.5)
		closed, opened, lost = [], [], []

		def move(velocity):
			model.setTarget('top', velocity)
			look.run(steps, samples=2)
			model.setTarget('top', 0)
			look.run(400, samples=1) # waves die out
			return model.groupForce('top') / 0.1

		for cycle in range(100):
			opened.append(move(stroke / steps))
			move(-stroke / steps)
			closed.append(move(-stroke / steps))
			move(stroke / steps)
			lost.append(energy('Damping') + energy('Friction') + energy('Fracture'))
		expected = -stroke / (0.2 / young + 1 / kn)
		where = 'free' if contact else 'joint'
		look.true((model.pointStatus != 0).all(), '%s: broken' % where)
		# it is linear but for depths by lengths (1e-5/0.1, free) and rotations; waves are down to 0.5^(400/20)
		look.below('closing stress off by', abs(np.array(closed) / expected - 1).max(), 1e-3)
		look.below('scatter of closings', np.ptp(closed[1:]) / abs(expected), 1e-5)
		look.below('stress when open', abs(np.array(opened)).max() / abs(expected), 1e-5)
		look.true((np.diff(lost) >= -1e-9 * max(lost)).all(), 'dissipation never falls, energy error %.0e' % look.runError)
