# yade-blocks, GPL-2.0-or-later
"""Joints that soften: with energies at the bound below which a point snaps back and far above it, very stiff, and under a pressure that it cannot follow."""
import math

from looks import *
from yadeblocks.engines import loopList

ft, cohesion, kn = 1e6, 2e6, young / 0.2 # [Pa], [Pa], [Pa/m]
strengths = dict(tension=ft, cohesion=cohesion, frictionAngle=0.6, frictionAngleResidual=0.5)


def energiesAt(factor, kn=kn):
	"""Fracture energies of so many times the bound, (ft^2/(kn GfI))^2 + (c^2/(ks GfII))^2 = 1, to which both contribute alike."""
	return dict(GfI=factor * math.sqrt(2) * ft**2 / kn, GfII=factor * math.sqrt(2) * cohesion**2 / (kn / 2))


def twoBlocks(kn, **properties):
	begin()
	model = BlockModel(thickness=1)
	for y in 0, 0.2:
		model.addRegion(rectangle(0, y, 0.2, y + 0.2), 'rock', zoneSize=0.1, zoning='regular')
	model.bond(joints(kn, **properties))
	return model


def pull(look, stroke, kn=kn, steps=4000, **energies):
	"""Pulled apart by `stroke`; the stresses every ten steps."""
	model = twoBlocks(kn, **strengths, **energies)
	model.drive('low', level(model, 0), 'xy')
	model.drive('top', level(model, 0.4), 'y', velocity=stroke / steps, rampTime=steps / 10)
	model.insert()
	O.dt, O.engines = 1, loopList(alpha=0.5, rescueFile='')
	stresses = []
	for _ in range(steps // 10):
		look.run(10, samples=1)
		stresses.append(model.groupForce('top') / 0.2)
	return model, np.array(stresses)


@case('softening at {factor} x the bound', 'peak is the strength; GfI is dissipated, and no more')
@pytest.mark.parametrize('factor', [1.01, 10.])
def test_atTheBound(look, factor):
	both = energiesAt(factor)
	stroke = 12 * both['GfI'] / ft + 0.4 * ft / young
	model, stress = pull(look, stroke, steps=20000, **both)
	# read every 10 of 20000 steps of an elastic stress of stroke / (0.6 / young)
	look.equal('peak [Pa]', stress.max(), ft, 2 * 10 / 20000 * stroke / (0.6 / young) / ft)
	look.below('in the end, by the peak', abs(stress[-20:]).max() / ft, 0.01)
	# Parted at once (1.01: the column snaps back) the energy is that of the few steps in which it happens, by the trapezoidal rule
	look.equal('dissipated by opening [N/m]', energy('ModeI') / 0.2, both['GfI'], 0.01)
	look.true(min(energy('ModeI'), energy('ModeII') + 1e-9, energy('Friction') + 1e-9) > -1e-9, 'nothing was gained')
	look.true(model.snappedBack == 0, 'no point snapped back')


@case('softening at 1e6 x the bound', 'yields and goes on carrying its strength')
def test_farAboveTheBound(look):
	both = energiesAt(1e6)
	stroke = 4e-4
	model, stress = pull(look, stroke, **both)
	model.setTarget('top', 0)
	look.run(2000)
	stress = np.append(stress, model.groupForce('top') / 0.2)
	opened = model.groupTravelled('top') - ft * 0.4 / young
	look.equal('stress in the end [Pa]', stress[-1], ft * math.exp(-ft * opened / both['GfI']), 1e-3)
	look.true((model.pointStatus == 4).all(), 'all points softening')


@case('softening, kn x 1e3', 'peak and energy as with kn')
def test_stiff(look):
	both = energiesAt(10)
	stroke = 12 * both['GfI'] / ft + 0.4 * ft / young
	model, stress = pull(look, stroke, kn=1e3 * kn, steps=40000, **both)
	look.equal('peak [Pa]', stress.max(), ft, 0.1) # masses are scaled to the joint, so that their inertia is 1e3 times as large
	look.equal('dissipated by opening [N/m]', energy('ModeI') / 0.2, both['GfI'], 0.01)


@case('softening under 100 x its cohesion', 'snaps back, is counted, gains nothing, slides at its residual friction')
def test_pressure(look):
	c, pressure = 1e4, 1e6
	# at three times the bound without pressure; under it shear would need ks > c (c + p (tan phi - tan phi_res))/GfII, 14 times the ks it has
	model = twoBlocks(kn, tension=5e3, cohesion=c, frictionAngle=math.atan(0.8), frictionAngleResidual=math.atan(0.6), GfI=1, GfII=3 * c**2 / (kn / 2))
	model.drive('low', range(model.firstNode[1]), 'xy')
	top = range(model.firstNode[1], model.firstNode[2])
	model.push('weight', top, 'y', force=-pressure * 0.2, rampTime=500)
	model.drive('side', top, 'x', velocity=1e-4 / 3000, startTime=2000, rampTime=300)
	model.insert()
	O.dt, O.engines = 1, loopList(alpha=0.5, rescueFile='')
	with messages() as texts:
		look.run(2000)
		look.true(model.snappedBack == 0, 'none before it slides')
		look.run(3000)
	look.true(model.snappedBack > 0, '%d points snapped back' % model.snappedBack)
	look.true(texts[0].count('snapped back') == 1, 'said once')
	look.equal('shear stress [Pa]', model.groupForce('side') / 0.2, 0.6 * pressure, 1e-3)
	look.true(min(energy(name) for name in ('ModeI', 'ModeII', 'Friction')) >= 0, 'nothing was gained')
