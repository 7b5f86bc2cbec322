# yade-blocks, GPL-2.0-or-later
"""Pictures of what goes on in a specimen: what is drawn, against stress states known by hand, and that every call leaves a picture."""
import matplotlib.image
import numpy as np
import pytest

from scenes import *
from yadeblocks import export, picturesfields, snapshot
from yadeblocks.pictures import view


@pytest.fixture(scope='module')
def column():
	"""Two blocks of 40 x 20 mm on top of each other, the upper one 1 um to the right and 2 um up; a joint of 40 mm between them."""
	materials()
	model = BlockModel(thickness=0.05)
	for label, low in (('unit', 0), ('mortar', 0.02)):
		model.addRegion(rectangle(0, low, 0.04, low + 0.02), label, zoneSize=0.02)
	model.bond([strong()[1]])
	model.insert()
	O.dt, O.engines = 1e-3, [BlockLoop(), BlockMotion()]
	O.run(1, True)
	model.displacement[model.firstNode[1]:] = (1e-6, 2e-6)
	return model


def test_motionOfJoints(column):
	"""Opening along the outward normal of the first block, slip along that turned by +90 degrees."""
	opening, slip = export.jointMotion(column)
	up = column.normal[0, 1] # out of the lower block if that is the first
	assert abs(up) == 1 and opening == pytest.approx(2e-6, rel=1e-6) and slip == pytest.approx(-1e-6, rel=1e-6)


def test_everyPicture(column, tmp_path):
	"""Each is a picture with more than one colour in it, and a field that is not there is refused."""
	snap = snapshot.Snapshot(column, 0.5)
	calls = [(picturesfields.drawField, what) for what in picturesfields.fields] + [(picturesfields.drawJoints, what) for what in picturesfields.onJoints]
	for draw, what in calls[::3] + [(picturesfields.drawCrosses, None), (picturesfields.drawSheet, None)]:
		path = draw(tmp_path / 'a.png', snap, *([what] if what else []))
		picture = matplotlib.image.imread(path)
		assert min(picture.shape[:2]) > 300 and len(np.unique(picture[::7, ::7, :3].reshape(-1, 3), axis=0)) > 5, what
	with pytest.raises(ValueError, match="what must be one of u, ux, uy.*, got 'sx'"):
		picturesfields.drawField(tmp_path / 'b.png', snap, 'sx')
	with pytest.raises(ValueError, match="what must be one of sigma, tau, opening, slip, got 's1'"):
		picturesfields.drawJoints(tmp_path / 'b.png', snap, 's1')


@pytest.fixture(scope='module')
def pressed():
	"""A brick that lies loose on another and is pressed by 1 kN; a rigid block holds the lower one."""
	materials()
	model = BlockModel(thickness=0.05)
	plate = model.addRigid(rectangle(-0.01, -0.02, 0.05, 0), 'mortar')
	model.addRegion(rectangle(0, 0, 0.04, 0.02), 'unit', zoneSize=0.02)
	model.addRegion(rectangle(0, 0.021, 0.04, 0.041), 'unit', zoneSize=0.02) # a gap of a millimetre
	model.bond(glued())
	top = nodesWhere(model, lambda x, y: y > 0.041 - 1e-9)
	model.push('press', top, 'y', force=-1e3)
	model.drive('side', top, 'x')
	model.insert()
	O.bodies[model.bodyOf(plate)].state.blockedDOFs = 'xyzXYZ'
	O.dt, O.engines = 1e-4, [ForceResetter(), BlockLoop(contact=True), NewtonIntegrator(damping=0.3), BlockMotion(alpha=0.5)]
	O.run(3000, True)
	return model


def test_freeContactsAndReactions(pressed, tmp_path):
	"""Equilibrium: what presses goes through the contact into the plate; contacts lie where the bricks meet, over their whole length."""
	contacts = pressed.freeContacts()
	upper = contacts['force'] * np.where(contacts['blocks'][:, :1] == 2, 1, -1) # on the upper brick
	assert upper.sum(axis=0) == pytest.approx((-pressed.groupForce('side'), 1e3), abs=1) and set(contacts['blocks'].ravel()) == {1, 2}
	lines, blocks, force = export.freeContactLines(pressed)
	assert np.abs(lines[:, :, 1] - 0.02).max() < 1e-5 and np.hypot(*(lines[:, 1] - lines[:, 0]).T).sum() == pytest.approx(0.04, rel=1e-3)
	reactions = {name: (place, force) for name, place, force in snapshot.reactionsOf(pressed)}
	assert reactions['press'][1] == pytest.approx((0, -1e3)) and reactions['block 0'][1] == pytest.approx((-pressed.groupForce('side'), 1e3), abs=1)
	assert reactions['press'][0] == pytest.approx((0.02, 0.04), abs=1e-5)
	assert pressed.groupMoment('press', (0, 0)) == pytest.approx(-1e3 * 0.02, rel=0.05) # as even as the stress is
	assert pressed.groupMoment('press', (1, 5)) - pressed.groupMoment('press', (0, 0)) == pytest.approx(1e3, rel=1e-9) # M' = M - r x F
	assert list(pressed.groupNodes('side')) == list(pressed.groupNodes('press')) and pressed.groupAxes('press') == 'y' and pressed.groupAxes('side') == 'x'
	taken = snapshot.Snapshot(pressed, 0)
	assert np.array_equal(export.freeContactLines(taken)[0], lines) and [name for name, _, _ in taken.reactions] == ['press', 'side', 'block 0']
	for number, draw in enumerate((picturesfields.drawContacts, picturesfields.drawReactions)):
		picture = matplotlib.image.imread(draw(tmp_path / f'{number}.png', taken))
		assert min(picture.shape[:2]) > 300 and len(np.unique(picture[::7, ::7, :3].reshape(-1, 3), axis=0)) > 5
	export.BlocksExport(tmp_path).write(pressed, 0)
	assert f'NumberOfCells="{len(lines)}"'.encode() in (tmp_path / 'contacts_0000.vtu').read_bytes()


def test_strainsOfTurnedZones(column):
	"""A stretch of 1e-3 along x, then a turn by 40 degrees: U - 1 knows nothing of the turn."""
	snap = snapshot.Snapshot(column, 0)
	turn = np.array([(np.cos(0.7), -np.sin(0.7)), (np.sin(0.7), np.cos(0.7))])
	snap.position = (np.asarray(snap.reference) * (1 + 1e-3, 1) + (3, 4)) @ turn.T
	assert export.zoneStrains(snap) == pytest.approx(np.tile((1e-3, 0, 0), (len(snap.zoneNodes), 1)), abs=1e-12)


def test_movies(column, tmp_path):
	"""As many frames as states, each another picture, all of one size; what a system cannot write is said."""
	from PIL import Image
	states = []
	for number in range(4):
		column.displacement[column.firstNode[1]:] = (0, number * 1e-6)
		states.append(snapshot.Snapshot(column, 0.1 * number, like=states[-1] if states else None))
	column.displacement[column.firstNode[1]:] = (1e-6, 2e-6)
	for what in ('uy', 'opening', 'cracks'):
		movie = Image.open(picturesfields.drawMovie(tmp_path / f'{what}.gif', states, what))
		assert movie.n_frames == 4 and min(movie.size) > 100, what
		frames = []
		for number in range(4):
			movie.seek(number)
			frames.append(np.asarray(movie.convert('RGB')).tobytes())
		assert len(set(frames)) == 4, what # the title has the time
	for path, words in (('a.avi', "path's ending must be one of .gif, .mp4, got '.avi'"), ('a.gif', "what must be one of u, ")):
		with pytest.raises(ValueError, match=words):
			picturesfields.drawMovie(tmp_path / path, states, 'uy' if path == 'a.avi' else 'nothing')
	with pytest.raises(ValueError, match='there are no states'):
		picturesfields.drawMovie(tmp_path / 'b.gif', [])


def test_filmTakesFramesByItself(column):
	film = snapshot.Film(column)
	O.engines = O.engines + [film.engine(2)]
	O.run(6, True)
	O.engines = O.engines[:-1]
	assert len(film.frames) == 3 and film.frames[0].time < film.frames[2].time


def test_nothingIsCutOff():
	"""Fragments and platens are in the picture, but not what has flown further than the specimen is large."""
	reference = np.array([(0, 0), (1, 0), (1, 2), (0, 2.)])
	low, high = view.windowAround(reference, reference + [(0, 0), (1.5, 0), (0, 0), (0, 0)])
	assert high[0] == pytest.approx(2.5, abs=0.05) and low == pytest.approx((0, 0), abs=0.05)
	assert view.windowAround(reference, reference + [(0, 0), (50, 0), (0, 0), (0, 0)])[1][0] == pytest.approx(1, abs=0.05)


def test_rigidBlocksAlone(tmp_path):
	"""No zones, no joints: what cannot be shown is left out."""
	materials()
	model = BlockModel(thickness=0.05)
	model.addRigid(rectangle(0, 0, 1, 1), 'unit')
	model.bond([])
	assert picturesfields.drawSheet(tmp_path / 'a.png', model).stat().st_size > 5000
	export.BlocksExport(tmp_path).write(model, 0)
	assert b'NumberOfCells="0"' in (tmp_path / 'joints_0000.vtu').read_bytes()


def test_snapshotsStayAsTheyWere(column):
	snap = snapshot.Snapshot(column, 0.5)
	before, other = np.array(snap.position), snapshot.Snapshot(column, 0.6, like=snap)
	column.displacement[0] += 1e-3
	assert np.array_equal(snap.position, before) and other.reference is snap.reference and list(snap.poisson) == [0.2, 0.2]
	column.displacement[0] -= 1e-3


def test_removedBlocksAreNotDrawn(column, tmp_path):
	"""Every kind of picture, a film and a file: half of the column is gone and white, the values of what is left make the colours."""
	from yadeblocks import pictures
	column.displacement[:] = 0
	column.displacement[column.firstNode[1]:] = (1e-6, 2e-6)
	before = snapshot.Snapshot(column, 0.5)
	column.remove([0])
	after = snapshot.Snapshot(column, 0.6, like=before)
	assert list(before.removedBlocks) == [] and list(after.removedBlocks) == [0]
	area = lambda path: (matplotlib.image.imread(path)[..., :3].min(axis=2) < 0.985).mean()
	draws = [(pictures.drawCracks, ()), (picturesfields.drawField, ('uy', )), (picturesfields.drawField, ('s1', )), (picturesfields.drawCrosses, ()),
			(picturesfields.drawJoints, ('opening', ))]
	for number, (draw, what) in enumerate(draws):
		shares = [area(draw(tmp_path / f'{number}-{k}.png', model, *what, window=(0, 0, 0.04, 0.04))) for k, model in enumerate((before, after))]
		assert shares[1] < 0.75 * shares[0], (draw, what, shares)
	whole, left = (view.View(model, None, None) for model in (before, after)) # each spans what it shows, with 1.5 % around
	assert whole.low[1] == pytest.approx(0, abs=1.7e-3) and left.low[1] == pytest.approx(0.02, abs=1e-3) and left.high[1] == pytest.approx(0.04, abs=1e-3)
	assert [view.View(model, None, None).magnification for model in (before, after)] == [500, 1] # 2 % of 40 mm by 1.1 um
	export.writeStates(tmp_path, *(export.State(model, model.time) for model in (before, after)))
	cells = [(tmp_path / f'{name}_000{number}.vtu').read_bytes().split(b'NumberOfCells="')[1].split(b'"')[0] for name in ('blocks', 'joints')
			for number in (0, 1)]
	assert int(cells[1]) == int(cells[0]) // 2 and cells[2:] == [b'4', b'0']
	from PIL import Image
	movie, frames = Image.open(picturesfields.drawMovie(tmp_path / 'a.gif', [before, after], 'cracks')), []
	for number in (0, 1):
		movie.seek(number)
		picture = np.asarray(movie.convert('RGB')).astype(int)
		frames.append((abs(picture - picture[0, 0]).max(axis=2) > 12).mean()) # not of the paper
	assert frames[1] < 0.75 * frames[0], frames
