# yade-blocks, GPL-2.0-or-later
"""A rigid platen that is driven: a smooth start, a servo that slows it where the blocks cannot follow, the leap over the elastic part.

	platen = Platen(model, plate, velocity=(0, -1e-3), rampTime=0.1, servo=dict(floor=10))   # plate: index of a rigid block, after insert()
	O.engines = [platen.engine()] + O.engines                                                # first of all
	platen.jump()                                                                            # instead of the ramp, where joints are whole
	O.run(1000, True)
	print(platen.force, platen.displacement, platen.throttle)"""
import numpy as np

from ._door import door
from .recording import runner


class Platen:
	"""A rigid block (index) that moves at velocity (vx, vy) [m/s] and does not turn, reached smoothly within rampTime [s] as a driven group's; times count
	from now. It is held along both axes from now on; velocity (0, 0): that is all.

	servo: None, or a dictionary of target (unbalanced ratio to keep [-], 1e-3), floor (least sum of forces that counts [N], 0), least (least speed as a
	fraction of the velocity, 0.05) and period (steps between two looks, 10), as of BlockServo. `throttle`: the present fraction, with or without a servo.

	Errors: ValueError for a block that is not rigid, numbers that are none, a negative ramp and a servo's value beyond BlockServo's limits;
	RuntimeError before insert()."""
	@door('rampTime', model='model', block='whole', velocity='point', servo='mapping')
	def __init__(self, model, block, velocity, rampTime=0.0, servo=None):
		from yade.wrapper import Omega
		self.model, self.block, self.velocity, self.rampTime = model, int(block), np.array(velocity, float), float(rampTime)
		if not (rampTime >= 0 and np.isfinite(rampTime)): raise ValueError(f"Platen.rampTime must not be negative [s], got {rampTime!r}")
		body = model.bodyOf(self.block)
		if model.firstZone[self.block] != model.firstZone[self.block + 1]:
			raise ValueError(f"Platen.block must be rigid, got {block!r}, which has zones")
		self.servo = None if servo is None else _servo(**servo)
		self.throttle, self._startTime, self._start = 1.0, Omega().time, Omega().iter
		self.body = Omega().bodies[body]
		self.body.state.blockedDOFs = "xyzXYZ"
		self.body.state.angVel = (0, 0, 0)
		self._setSpeed()

	def __call__(self):
		"""Sets the velocity of the coming step."""
		from yade.wrapper import Omega
		step = Omega().iter
		if self.servo and step > self._start and step % self.servo["period"] == 0: # the forces are those of the last step
			self.throttle *= 0.8 if self.model.unbalancedRatio(floor=self.servo["floor"]) > self.servo["target"] else 1.1
			self.throttle = min(1.0, max(self.servo["least"], self.throttle))
		self._setSpeed()

	def _setSpeed(self):
		from yade.wrapper import Omega
		O = Omega()
		x = min(1.0, (O.time + O.dt / 2 - self._startTime) / self.rampTime) if self.rampTime > 0 else 1.0
		self.body.state.vel = (*(self.throttle * x * x * (3 - 2 * x) * self.velocity), 0)

	def engine(self):
		"""For the beginning of O.engines."""
		return runner(f"platen {self.block}", self, initRun=True)

	@door('fraction')
	def jump(self, fraction=0.97):
		"""BlockModel.elasticJump with this platen at its velocity; there is no ramp any more. What it returns, and its errors, after which all is as it
		was."""
		before, self.rampTime = self.rampTime, 0.0
		self._setSpeed()
		try:
			return self.model.elasticJump(fraction)
		except Exception:
			self.rampTime = before
			self._setSpeed()
			raise

	@property
	def force(self):
		"""Force that drives it, along x and y, in the last step [N], an array: what it puts on the blocks, if nothing else (weight, permF) acts on
		it."""
		from yade.wrapper import Omega
		return -np.array(Omega().forces.f(self.body.id))[:2]

	@property
	def displacement(self):
		"""How far it has come (ux, uy) [m], an array."""
		return np.array(self.body.state.pos - self.body.state.refPos)[:2]


@door('target', 'floor', 'least', 'period')
def _servo(target=1e-3, floor=0.0, least=0.05, period=10):
	"""A servo's settings, checked."""
	if not (target > 0 and np.isfinite(target)): raise ValueError(f"Platen.servo: target must be positive, got {target!r}")
	if not (floor >= 0 and np.isfinite(floor)): raise ValueError(f"Platen.servo: floor must not be negative [N], got {floor!r}")
	if not 0 < least <= 1: raise ValueError(f"Platen.servo: least must lie in (0, 1], got {least!r}")
	if not (period >= 1 and int(period) == period): raise ValueError(f"Platen.servo: period must be a whole number of at least 1, got {period!r}")
	return dict(target=target, floor=floor, least=least, period=int(period))
