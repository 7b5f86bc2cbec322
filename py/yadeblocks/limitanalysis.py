# yade-blocks, GPL-2.0-or-later
"""Limit analysis: the largest load that joints can hold if blocks are rigid and joints do not soften, by a linear programme.

	limit = largestMultiplier(model, bodyForces(model, (9.81, 0)), bodyForces(model, (0, -9.81)), fixed=[base])
	limit = largestForce(model, 'shoe', (0, -1))       # of a group that is driven, the model's other groups hold
	limit.load, limit.sigma, limit.tau, limit.mechanism
	pictures.drawMechanism('mechanism.png', model, limit.mechanism)

It takes the model as it was built, before any step, and so is a check on what steps find (static theorem: Drucker, Greenberg and Prager 1952; blocks with
friction: Livesley 1978). It is the exact limit if joints dilate by their friction angle. Without dilation it is an upper bound. Joints that soften or are
brittle hold less, as they are not all at their strength at once. Crushing (the cap) is left out."""
from collections import namedtuple

import numpy as np

from ._door import door
from ._kinds import shown
from .plane import cross, left
from .readings.blocks import areasAndCentroids, blockOfNodes
from .readings.materials import ofMaterials
from .readings.status import intact, neverBonded

#: load: the multiplier [-] or the force [N] at the limit; sigma, tau: stresses of the contact points there, tension positive [Pa], in general not the only
#: possible ones; mechanism: how the blocks then move, velocity of the centroid [m/s] and rotation [rad/s], (blocks, 3), so that the load's power is 1 W, or
#: 1 W by its multiplier.
Limit = namedtuple('Limit', 'load sigma tau mechanism')

#: By the size of the scene: what grid points of a rigid block may be off by where nothing has moved.
roundings = 1e-12


@door(model='blockModel', acceleration='point')
def bodyForces(model, acceleration):
	"""Mass times an acceleration [m/s2] for every block, at its centroid, (blocks, 2) [N]: weights with (0, -9.81)."""
	density = ofMaterials(model, 'density')[model.blockMaterial]
	areas, _ = areasAndCentroids(model)
	return (density * areas * model.thickness)[:, None] * np.asarray(acceleration, float)


@door(model='blockModel', growing='points', constant='points', fixed='nodes')
def largestMultiplier(model, growing, constant=None, fixed=None):
	"""The largest factor on the forces `growing`, besides which the forces `constant` act -> Limit.

	growing, constant: forces on the blocks at their centroids, (blocks, 2) [N], `bodyForces` say; fixed: blocks that do not move. Grid points that groups
	hold or drive do not move along their axes either; those that a group pushes move as one, under its force. Nothing else acts: gravity, tractions and
	stresses in situ of the model count for nothing, and viscous boundaries hold nothing.

	Errors: ValueError where the constant forces cannot be held with any factor >= 0, where no factor is too large, and for arrays that do not fit the
	model; RuntimeError for a model without joints, that has moved, with blocks taken out, or with joints that have broken or soften."""
	problem = _Problem(model, fixed)
	problem.carry('growing', growing, problem.load(1 / max(np.abs(growing).max(), 1e-300)))
	if constant is not None: problem.carry('constant', constant)
	return problem.solved()


@door(model='blockModel', group='str', direction='point', constant='points', fixed='nodes')
def largestForce(model, group, direction, constant=None, fixed=None):
	"""The largest force of a group of the model on the blocks, by its component along a direction, whatever its distribution over the grid points -> Limit.

	group: a name of BlockModel.groups, held, driven or pushed (its force is what is asked for then); direction: (x, y) of any length > 0; constant, fixed
	and errors: as in `largestMultiplier`; ValueError for a group that is not there, or that does not act along the direction."""
	known = ', '.join(model.groups) or 'none: there are no groups'
	if group not in model.groups: raise ValueError(f'largestForce.group must be one of {known}, got {group!r}')
	direction = np.asarray(direction, float)
	acts = np.array([axis in model.groupAxes(group) for axis in 'xy'])
	if not (direction[acts] != 0).any():
		raise ValueError(f'largestForce.direction must not be across the axes {model.groupAxes(group)} of {group!r}, got {tuple(direction)!r}')
	problem = _Problem(model, fixed, asked=group)
	problem.count(group, direction / np.hypot(*direction), problem.load(1))
	if constant is not None: problem.carry('constant', constant)
	return problem.solved()


class _Problem:
	"""Equilibrium of every block that is not fixed, about its centroid, and of what pushes them. Columns: normal and shear stress of each contact point, a
	force of each grid point of a group along each axis, the load. What the programme sees is scaled to numbers near 1."""
	def __init__(self, model, fixed, asked=None):
		self.model, self.blocks = model, model.blockCount
		if not len(model.segmentBlocks): raise RuntimeError('limit analysis: there are no joints; BlockModel.bond() makes them')
		if len(model.removedBlocks): raise RuntimeError(f'limit analysis: no block must have been taken out, got {shown(model.removedBlocks)}')
		size, moved = np.ptp(np.asarray(model.reference), axis=0).max(), abs(np.asarray(model.position) - model.reference).max()
		if moved > roundings * size:
			raise RuntimeError(f'limit analysis: the model must be as it was built; grid points have moved by up to {moved:.3g} m')
		changed = np.count_nonzero(~np.isin(model.pointStatus, (intact, neverBonded)))
		if changed: raise RuntimeError(f'limit analysis: joints must be as they were built; {changed} contact points have broken or soften')
		self.moves = np.ones(self.blocks, bool)
		if fixed is not None:
			if not (0 <= min(fixed) and max(fixed) < self.blocks):
				raise ValueError(f'limit analysis: fixed must be blocks of the model, 0 to {self.blocks - 1}, got {shown(fixed)}')
			self.moves[fixed] = False
		_, self.centroids = areasAndCentroids(model)
		self.entries, self.right, self.scale = [], np.zeros(3 * self.blocks), []
		self.held = {} # (group, axis) -> columns
		self._joints()
		self._groups(asked)

	def carry(self, name, forces, column=None):
		"""Forces at centroids: a constant part, or with a column what it multiplies."""
		forces = np.asarray(forces, float)
		if len(forces) != self.blocks: raise ValueError(f'limit analysis: {name} must have a force for each of {self.blocks} blocks, got {len(forces)}')
		for axis in range(2):
			rows = 3 * np.arange(self.blocks) + axis
			if column is None: self.right[rows] -= forces[:, axis]
			else: self.entries.append((rows, np.full(self.blocks, column), forces[:, axis]))

	def load(self, by):
		"""The column of the load, which is about a force times `by`."""
		return self._columns(1, by, force=True)[0]

	def count(self, group, direction, load):
		"""The load is the force of a group along a direction."""
		row = len(self.right)
		self.right = np.append(self.right, 0)
		for axis, part in zip('xy', direction):
			columns = self.held.get((group, axis), np.zeros(0, int))
			self.entries.append((np.full(len(columns), row), columns, np.full(len(columns), part)))
		self.entries.append((np.array([row]), np.array([load]), np.array([-1.])))

	def solved(self):
		"""The last column, the load, as large as it may be."""
		linprog, coo_array = _scipy()
		rows, columns, values = (np.concatenate(part) for part in zip(*self.entries))
		stress = max(self.cohesion.max(), self.tension.max(), np.abs(self.right).max() / self.area.mean()) or 1
		force = stress * self.area.mean()
		scale = np.array([by * (force if isForce else stress) for by, isForce in self.scale])
		balance = np.append(
			np.tile([1, 1, 1 / np.ptp(np.asarray(self.model.reference), axis=0).max()], self.blocks), np.ones(len(self.right) - 3 * self.blocks)
		) / force
		kept = np.append(np.repeat(self.moves, 3), np.ones(len(self.right) - 3 * self.blocks, bool))
		equilibrium = coo_array((values * balance[rows] * scale[columns], (rows, columns)), (len(self.right), len(scale))).tocsr()[kept]
		sigma = np.arange(self.points)
		tau, ones = sigma + self.points, np.ones(self.points)
		slides = coo_array((
			np.concatenate([self.friction, ones, self.friction, -ones]),
			(np.concatenate([sigma, sigma, tau, tau]), np.concatenate([sigma, tau, sigma, tau]))
		), (2 * self.points, len(scale))).tocsr()
		goal = np.zeros(len(scale))
		goal[-1] = -1
		found = linprog(
			goal, slides, np.tile(self.cohesion / stress, 2), equilibrium, (self.right * balance)[kept],
			[(None, most) for most in self.tension / stress] + [(None, None)] * (len(scale) - self.points - 1) + [(0, None)], 'highs'
		)
		if found.status == 2: raise ValueError('limit analysis: joints and supports cannot hold the constant forces, whatever the load')
		if found.status == 3: raise ValueError('limit analysis: no load is too large: joints and supports hold any, or the load does no work')
		if found.status: raise RuntimeError('limit analysis: ' + found.message)
		motion = np.zeros(3 * self.blocks)
		motion[kept[:len(motion)]] = -found.eqlin.marginals[:3 * self.moves.sum()]
		motion *= balance[:len(motion)] * scale[-1]
		values = found.x * scale
		return Limit(values[-1], values[sigma], values[tau], motion.reshape(-1, 3))

	def _joints(self):
		model = self.model
		both = lambda column: np.repeat(np.asarray(column), 2, axis=0) # two contact points a joint
		properties = {name: both(column) for name, column in model.jointProperties.items()}
		never = np.asarray(model.pointStatus) == neverBonded
		self.cohesion, self.tension = (np.where(never, 0, properties[name]) for name in ('cohesion', 'tension'))
		self.friction = np.tan(np.where(never, properties['frictionAngleResidual'], properties['frictionAngle']))
		self.area, self.points = both(model.segmentArea), len(never)
		normal, places = both(model.normal), np.asarray(model.contactPositions())
		for direction in (normal, left(normal)): # a tension draws the first block to the second
			columns = self._columns(self.points, 1, force=False)
			for side, sign in ((0, 1), (1, -1)):
				self._force(both(model.segmentBlocks)[:, side], columns, places, sign * self.area[:, None] * direction)

	def _groups(self, asked):
		model, blocks = self.model, blockOfNodes(self.model)
		for group in model.groups:
			nodes = np.asarray(model.groupNodes(group))
			for axis in model.groupAxes(group):
				columns = self.held[group, axis] = self._columns(len(nodes), 1, force=True)
				unit = np.tile((axis == 'x', axis == 'y'), (len(nodes), 1)).astype(float)
				self._force(blocks[nodes], columns, np.asarray(model.reference)[nodes], unit)
			push = model.groupPushForce(group)
			if push is not None and group != asked: # along its one axis
				self.entries.append((np.full(len(columns), len(self.right)), columns, np.ones(len(columns))))
				self.right = np.append(self.right, push)

	def _columns(self, count, by, force):
		self.scale += [(by, force)] * count
		return np.arange(len(self.scale) - count, len(self.scale))

	def _force(self, blocks, columns, places, forces):
		arm = places - self.centroids[blocks]
		for axis, values in enumerate((forces[:, 0], forces[:, 1], cross(arm, forces))):
			self.entries.append((3 * blocks + axis, columns, values))


def _scipy():
	try:
		from scipy.optimize import linprog
		from scipy.sparse import coo_array
	except ImportError as error:
		raise ImportError('limit analysis needs scipy: scripts/install.sh python3-scipy') from error
	return linprog, coo_array
