# yade-blocks, GPL-2.0-or-later
"""Pictures of what goes on in a specimen: what is drawn, against stress states known by hand, and that every call leaves a picture."""
import matplotlib.image
import numpy as np
import pytest

from scenes import *
from yadeblocks import export, picturesfields, snapshot


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
