# yade-blocks, GPL-2.0-or-later
"""Collections of files for ParaView."""
from pathlib import Path

from .. import files
from .._door import door
from .state import State
from .vtu import writeCollection, writeGrid


class BlocksExport:
	"""Three collections for ParaView in `folder`, begun anew: blocks.pvd (zones; rigid blocks as triangles between their corners), joints.pvd
	(a line for every contact point, its half of the segment) and contacts.pvd (a line for every two edges that touch without a bond), each with a
	compressed .vtu file per step. Blocks that have been removed are not in it. Where joints have names (BlockModel.nameJoints), joints.names.csv says
	which number stands for which.

	Zones: block, material (number in O.materials' order), stresses sxx, syy, sxy, szz, principal stresses s1, s2 in the plane and vonMises [Pa],
	strains exx, eyy, exy; grid points: displacement [m], velocity [m/s];
	joints: firstBlock, secondBlock, name (a number, -1 without), normal (out of the first block), area [m2], opening [m], slip [m], sigma [Pa], tau [Pa],
	status (0 intact, 1 broken in tension, 2 in shear, 3 never bonded, 4 softening), damage (0 whole to 1, only residual strength is left) and the columns
	of a joint law of one's own (BlockModel.lawColumns);
	contacts: firstBlock, secondBlock and force on the first [N]."""
	@door(folder='file')
	def __init__(self, folder):
		self.folder = Path(folder)
		self.folder.mkdir(parents=True, exist_ok=True)
		self.times = []
		for name in ("blocks", "joints", "contacts"):
			for old in (self.folder / f"{name}.pvd", self.folder / f"{name}.names.csv", *self.folder.glob(f"{name}_[0-9]*.vtu")):
				old.unlink(missing_ok=True)

	@door(model='model', time='float')
	def write(self, model, time):
		"""Adds the model as it is now, at this time [s]."""
		self.add(State(model, time))

	def add(self, state):
		"""Adds a State."""
		for name, grid in state.grids.items():
			with files.replacing(self.folder / f"{name}_{len(self.times):04}.vtu") as part:
				writeGrid(part, *grid)
		if state.names:
			lines = [f'{number},"{name.replace(chr(34), 2 * chr(34))}"' for number, name in enumerate(state.names)]
			files.replace(self.folder / "joints.names.csv", ("number,name\n" + "\n".join(lines) + "\n").encode())
		self.times.append(state.time)
		for name in state.grids:
			writeCollection(self.folder, name, self.times)


@door(folder='file')
def writeStates(folder, *states):
	"""Both collections at once, of these States."""
	for state in states:
		if not isinstance(state, State): raise TypeError(f"writeStates.states must be States, and one is {state!r}")
	export = BlocksExport(folder)
	for state in states:
		export.add(state)


@door(folder='file', film='film', end='model')
def writeFilm(folder, film, end):
	"""The model untouched, the frames and the peak of a Film, and the Snapshot `end`, each once."""
	states = [snapshot for snapshot in film.states() if snapshot.time < end.time]
	writeStates(folder, State(end, 0, untouched=True), *(State(snapshot, snapshot.time) for snapshot in states if snapshot.time > 0), State(end, end.time))
