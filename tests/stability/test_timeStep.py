# yade-blocks, GPL-2.0-or-later
"""What is stable runs, what is not is refused or stopped."""
import math

import pytest

from looks import *


def trueLimit(model):
	"""2/omega of the fastest mode by power iteration on forces after small displacements; its relative uncertainty.

	The engines must not move anything. Some eigenvalue of M^-1 K is within |residual| of Rayleigh's quotient."""
	mass, rest = model.mass[:, None], np.array(model.displacement)
	small = 1e-7 * np.ptp(model.reference) # linear: frames turn by so little; against rounding 1e-9 of it

	def forces(shift):
		model.displacement[:] = rest + shift
		O.step()
		return np.array(model.force)

	mode, square, residual = np.random.default_rng(1).normal(size=rest.shape), 0, math.inf
	for _ in range(5000):
		mode *= small / abs(mode).max()
		image = (forces(-mode) - forces(mode)) / 2 / mass
		norm = (mass * mode * mode).sum()
		square = (mass * mode * image).sum() / norm
		residual = math.sqrt((mass * (image - square * mode)**2).sum() / norm) / square
		if residual < 1e-4: break
		mode = image
	model.displacement[:] = rest
	return 2 / math.sqrt(square), residual / 2


def safetyCase(look, damping, alpha=0.3):
	joint = joints(young / 0.25, 0.8 * young / 0.25)
	begin()
	model = panel()
	model.insert()
	O.dt = 1e-9
	O.engines = engines(joint)[:1] + [BlockForces()]
	limit, uncertain = trueLimit(model)
	allowed = 0.95 / math.sqrt(1 + (alpha if damping == 'local' else 0))

	def attempt(stepper, dt):
		look.forget()
		begin()
		model = panel()
		model.insert()
		kick(model, 1e-7)
		O.dt, O.engines = dt, engines(joint, stepper, damping=damping, alpha=alpha)

		def run():
			look.run(1)
			look.start = sum(energy(e) for e in ('Kinetic', 'Zones', 'Joints')) # what the kick gave
			look.run(3000)

		found, message = outcome(run)
		if found != 'silent': return found
		# U (1 - s^2) of a mode is never more than what there was; s as a share of the true limit
		share = O.dt / limit if stepper is None else stepper['safety']
		return 'stable' if share < 1 and energy('Zones') + energy('Joints') <= look.start / (1 - share**2) * 1.01 else 'silent'

	safeties = [0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 1.02, 1.1]
	byTrue = [attempt(None, s * limit) for s in safeties]
	byStepper = [attempt(dict(safety=s), 1e-3) for s in safeties]
	begin()
	model = panel()
	model.insert()
	O.dt, O.engines = 1e-9, engines(joint, dict(dynamic, safety=0.5))
	O.step()
	bound = O.engines[1].stableStep / limit
	look.below('power iteration uncertain by', uncertain, 1e-3)
	look.true(bound <= 1 + uncertain, 'bound %.3f of the true limit' % bound)
	for name, found, fits in (('O.dt', byTrue, lambda s: s <= allowed * bound), ('safety', byStepper, lambda s: s <= allowed)):
		stable = [s for s, f in zip(safeties, found) if f == 'stable']
		stopped = [s for s, f in zip(safeties, found) if f in ('refused', 'detected')]
		look.true(
			stable == [s for s in safeties if fits(s)] and len(stable) + len(stopped) == len(safeties) and min(stopped) < 1,
			'%s: stable %g to %g, refused from %g on' % (name, stable[0], stable[-1], min(stopped))
		)


@pytest.mark.parametrize('damping, alpha', [('none', ''), ('local', ' 0.3'), ('local', ' 0.8'), ('adaptive', '')])
@case('safety, damping {damping}{alpha}', '0.5 to 1.1 times the limit of power iteration: stable or refused, never silent')
def test_safety(look, damping, alpha):
	safetyCase(look, damping, float(alpha or 0.3))


@case('joints stiffened x1e3 in the middle', 'the stepper follows; with O.dt kept the run is refused')
def test_stiffened(look):
	for stepper, expected in (dict(dynamic, safety=0.9), 'silent'), (None, 'refused'):
		look.forget()
		begin()
		model = panel()
		model.insert()
		kick(model, 1e-7)
		joint = joints(young / 0.25)
		O.engines = engines(joint, dict(dynamic, safety=0.9), damping='none')
		look.run(300)
		O.engines = engines(joint, stepper, damping='none')
		look.run(300)
		before = O.dt
		look.forget() # stiffening gives energy
		for i in O.interactions:
			i.phys.kn *= 1e3
		found, message = outcome(lambda: look.run(1000))
		look.true(found == expected, 'O.dt kept: ' + found if stepper is None else 'O.dt from %.2g to %.2g s' % (before, O.dt))
