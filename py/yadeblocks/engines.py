# yade-blocks, GPL-2.0-or-later
"""The list of a time step, in the one order in which it works.

	model.bond([JointMat(material1='rock', material2='rock', kn=2e12, ks=1e12, cohesion=10e6, tension=5e6, frictionAngle=0.6)])
	O.engines = loopList(alpha=0.3)

or, with YADE's own InteractionLoop and the same bits, at two to three times the cost,

	model.bond()
	O.engines = engineList([JointMat(material1='rock', material2='rock', kn=2e12, ks=1e12, cohesion=10e6, tension=5e6, frictionAngle=0.6)], alpha=0.3)
"""

from ._door import door


@door(contact='flag', servo='mapping', newton='mapping')
def loopList(contact=False, servo=None, newton=None, **motion):
	"""The engines of a scene of blocks whose joints have their properties from bond(), for `O.engines`; recorders and the like are added behind them.

	contact: whether blocks that have come apart may touch again; servo: attributes of a BlockServo, None for none; newton: attributes of the
	NewtonIntegrator that moves rigid blocks, None for none; the rest: attributes of BlockMotion (damping, alpha, safety, quasiStatic, ...)."""
	import yade.wrapper as y # where the plugin's classes are, too
	engines = [y.ForceResetter()] if newton is not None else []
	engines.append(y.BlockLoop(contact=contact)) # from where blocks are to the forces on them
	if servo is not None: engines.append(y.BlockServo(**servo)) # as slow as the blocks want it
	if newton is not None: engines.append(y.NewtonIntegrator(**newton)) # rigid blocks
	return engines + [y.BlockMotion(**motion)] # masses or O.dt, motion


@door(joints='sequence', contact='flag', stepper='mappingOrNone', servo='mapping', newton='mapping')
def engineList(joints, contact=False, stepper={}, servo=None, newton=None, **integrator):
	"""The engines of a scene of blocks, for `O.engines`; recorders and the like are added behind them.

	joints: a JointMat for every pair of materials that touch; contact: whether blocks that have come apart may touch again; stepper: attributes of
	BlockTimeStepper, None for none (then masses are true and O.dt is yours); servo: attributes of a BlockServo, None for none; newton: attributes of the
	NewtonIntegrator that moves rigid blocks, None for none; the rest: attributes of BlockIntegrator (damping, alpha, ...)."""
	import yade.wrapper as y # where the plugin's classes are, too
	engines = [y.ForceResetter()] if newton is not None else []
	if contact: engines += contactEngines()
	engines.append( # opening and slip; properties; stresses and failure of joints
		y.InteractionLoop(
		[y.Ig2_Block_Block_BlockGeom()], [y.Ip2_BlockMat_BlockMat_JointPhys(joints=joints)], [y.Law2_BlockGeom_JointPhys_MohrCoulomb()]
		)
	)
	if stepper is not None: engines.append(y.BlockTimeStepper(**stepper)) # scaled masses, or O.dt
	engines.append(y.BlockForces()) # zones and joints, gathered node by node
	if servo is not None: engines.append(y.BlockServo(**servo)) # as slow as the blocks want it
	if newton is not None: engines.append(y.NewtonIntegrator(**newton)) # rigid blocks
	return engines + [y.BlockIntegrator(**integrator)] # motion


def contactEngines():
	"""What stands in front of YADE's InteractionLoop where broken joints may slide on, part and meet again. Blocks need no collider."""
	import yade.wrapper as y
	return [y.BlockContacts()]


def find(kind):
	"""The first engine of this class in O.engines, by its name; None if there is none."""
	from yade.wrapper import Omega
	return next((engine for engine in Omega().engines if type(engine).__name__ == kind), None)


def addBehindForces(new):
	"""Puts an engine into O.engines where the forces of the step are known and nothing has moved yet."""
	from yade.wrapper import Omega
	engines = Omega().engines
	at = next(i for i, engine in enumerate(engines) if type(engine).__name__ in ("BlockLoop", "BlockForces")) + 1
	Omega().engines = engines[:at] + [new] + engines[at:]
