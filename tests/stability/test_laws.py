# yade-blocks, GPL-2.0-or-later
"""Joints with extreme strength, friction and dilation."""
import math

from looks import *


def pull(look, steps=4000, strain=2e-4, **joint):
	"""Two blocks and a joint, torn apart; greatest stress, the last one, and the stress of one step."""
	begin()
	model = column([0.2, 0.2])
	model.drive('low', level(model, 0), 'xy')
	model.drive('top', level(model, 0.4), 'y', velocity=strain * 0.4 / steps, rampTime=steps / 10)
	model.insert()
	O.dt, O.engines = 1, engines(joints(young / 0.2, **joint), alpha=0.5)
	stresses = []
	for _ in range(steps // 10):
		look.run(10, samples=1)
		stresses.append(model.groupForce('top') / 0.2)
	return model, np.array(stresses)


elasticStress = 2e-4 * 0.4 / (0.4 / young + 0.2 / young) # of `pull` if nothing breaks, but for the ramp


@case('strength zero', 'no tension at all')
def test_strengthZero(look):
	model, stress = pull(look, cohesion=0, tension=0)
	# Both halves are free: what remains is the inertia of a block that is pulled up. Its mass, scaled: K dt^2/(4 s^2), K about 10 E b t/h.
	look.below('stress by that of intact joints', abs(stress[len(stress) // 2:]).max() / elasticStress, 1e-3)
	look.true((model.pointStatus == 1).all(), 'all points broken in tension')


@case('strength normal', 'peak is the tensile strength')
def test_strengthNormal(look):
	model, stress = pull(look, cohesion=1e6, tension=1e6, frictionAngle=0.6)
	# the stress is read every 10 of 4000 steps: 10/4000 of the elastic stress; waves of the ramp's start as much again
	look.equal('peak [Pa]', stress.max(), 1e6, 2 * 10 / 4000 * elasticStress / 1e6)
	look.below('after the peak, by the peak', abs(stress[-50:]).max() / 1e6, 0.01)


@case('strength x1e9', 'elastic to the end')
def test_strengthHuge(look):
	model, stress = pull(look, cohesion=1e15, tension=1e15, frictionAngle=0.6)
	look.true((model.pointStatus == 0).all(), 'all points intact')
	look.equal('stress [Pa]', stress[-1], model.groupTravelled('top') / (0.6 / young), 1e-3)


@case('tension above cohesion/tan(phi)', 'fails at the apex of the cone, in shear')
def test_apex(look):
	model, stress = pull(look, cohesion=1e6, tension=1e7, frictionAngle=math.atan(0.8))
	look.equal('peak [Pa]', stress.max(), 1e6 / 0.8, 2 * 10 / 4000 * elasticStress / 1.25e6)
	look.true((model.pointStatus == 2).all(), 'all points broken in shear')


def shear(look, slip, pressure=1e6, contact=False, kn=young / 0.2, **joint):
	"""A block pressed upon another and pushed sideways; both move as rigid platens but for the joint. Uplift [m] and shear stress [Pa] at the end."""
	begin()
	model = column([0.1, 0.1])
	model.drive('low', range(model.firstNode[1]), 'xy')
	top = range(model.firstNode[1], model.firstNode[2])
	model.push('weight', top, 'y', force=-pressure * 0.2, rampTime=500)
	model.drive('side', top, 'x', velocity=slip / 3000, startTime=2000, rampTime=300)
	model.insert()
	O.dt, O.engines = 1, engines(joints(kn, **joint), contact=contact, alpha=0.5)
	look.run(1500)
	first = model.groupTravelled('weight')
	look.run(500 + 3000 + 150)
	model.setTarget('side', 0)
	look.run(1000)
	return model.groupTravelled('weight') - first, model.groupForce('side') / 0.2


@case('friction zero', 'slides without shear stress, point joint and free contact')
def test_frictionZero(look):
	for contact in False, True:
		look.forget()
		_, tau = shear(look, 2e-4, contact=contact, bonded=False)
		# The contact's energy kn d^2 L/2 falls as its length L does: a force kn d^2/2 in the direction of sliding, d/(2 L) of the normal one.
		overlap = 1e6 / (young / 0.2)
		look.below('tau/sigma' + (' (free)' if contact else ' (joint)'), abs(tau) / 1e6, overlap / 0.2 if contact else 1e-12)


@case('friction 89 degrees', 'sticks, then slides at sigma tan(89 degrees), point joint and free contact')
def test_frictionSteep(look):
	tangent, ks = math.tan(math.radians(89)), young / 0.4
	for contact in False, True:
		where = ' (free)' if contact else ' (joint)'
		for slip, tau in (1e-4, 1e-4 * ks), (2e-3, 1e6 * tangent): # 5 MPa sticks; 57 MPa needs 1.1e-3 m
			look.forget()
			uplift, measured = shear(look, slip, contact=contact, bonded=False, frictionAngle=math.radians(89))
			# slip makes the overlap of 0.2 m shorter, and free contact turns by its moments
			look.equal('tau [Pa]' + where, measured, tau, 1e-3 + 2 * slip / 0.2)


@case('dilation at its limit', 'uplift is tan(psi) x the limit slip, no more, and none is lost on the way back')
def test_dilationLimit(look):
	psi, limit, ks = math.radians(10), 1e-4, young / 0.4
	begin()
	joint = dict(cohesion=0, tension=0, frictionAngle=0.6, dilationAngle=psi, dilationLimitSlip=limit)
	for slip in 0.5e-4, 5e-4:
		look.forget()
		uplift, tau = shear(look, slip, **joint)
		plastic = min(slip - abs(tau) / ks, limit)
		look.equal('uplift [m]', uplift, math.tan(psi) * plastic, 1e-3)
