# yade-blocks, GPL-2.0-or-later
"""What BlockMotion makes of O.dt and of the masses. The bounds themselves are tested in tests/kernel/step/TimeStepTest.cpp."""
import numpy as np
import pytest

from scenes import *
from yadeblocks.engines import loopList


def standing(**motion):
	"""A column upon its foot, inserted, with engines."""
	materials()
	model = column()
	model.bond(strong()[:1])
	model.drive('foot', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.insert()
	O.dt, O.engines = 1e-3, loopList(rescueFile='', **motion)
	return model


def test_dtIsAShareOfTheStableStep():
	"""The stable step is that of the true masses, whatever share of it is taken."""
	found = []
	for safety in 0.3, 0.6:
		standing(quasiStatic=False, safety=safety)
		O.run(1, True)
		found.append(O.engines[-1].stableStep)
		assert O.dt == pytest.approx(safety * found[-1], rel=1e-15)
	assert found[0] == found[1]


def test_massesFollowDtAndSafety():
	"""Scaled masses go with (dt / safety)^2, also where one of the two changes in a run; true masses come back, to the bit."""
	model = standing(safety=0.6)
	O.run(2, True)
	scaled = model.inertia.copy()
	for dt, safety in (5e-4, 0.6), (5e-4, 0.3), (1e-3, 0.6):
		O.dt, O.engines[-1].safety = dt, safety
		O.run(2, True)
		np.testing.assert_allclose(model.inertia, scaled * (dt / 1e-3 * 0.6 / safety)**2, rtol=1e-14)
	assert not np.allclose(scaled, model.mass, rtol=0.1)
	O.engines[-1].quasiStatic = False
	O.run(2, True)
	assert (model.inertia == model.mass).all()


def test_blocksThatMeetTakeHalfTheStep():
	"""Springs of free contacts count four times where dt follows from the masses. Blocks that are soft beside them, E/kn = 1e-9 m: half the step."""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e6, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	for x in 0, 1 + 1e-6:
		model.addRegion(rectangle(x, 0, x + 1, 1), 'rock', zoneSize=0.5)
	with pytest.warns(UserWarning, match='touch'):
		model.bond([JointMat(material1='rock', material2='rock', kn=1e15, ks=1e15, bonded=False)], tolerance=1e-9)
		model.insert()
	O.engines = loopList(contact=True, safety=0.5, quasiStatic=False, damping='none', rescueFile='')
	O.run(3, True)
	assert O.dt == pytest.approx(0.5 * O.engines[-1].stableStep / 2, rel=1e-6)
