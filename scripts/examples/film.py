# yade-blocks, GPL-2.0-or-later
"""Pictures of all kinds and files for ParaView, of a layer of mortar that is torn."""
from pathlib import Path

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import pictures, picturesfields
from yadeblocks.engines import loopList
from yadeblocks.export import writeFilm
from yadeblocks.recording import Recorder
from yadeblocks.snapshot import Film, Snapshot
from yadeblocks.specimen import nodesWhere, rectangle

O.materials.append(BlockMat(label='mortar', young=3e9, poisson=0.2, density=1250))
model = BlockModel(thickness=0.05)
model.addVoronoi(rectangle(0, 0, 0.04, 0.02), 'mortar', size=5e-3, seed=1)
model.bond([JointMat(material1='mortar', material2='mortar', kn=4e11, ks=2e11, cohesion=6e5, tension=6e5, frictionAngle=0.66)])
model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.drive('top', nodesWhere(model, lambda x, y: y > 0.02 - 1e-9), 'y', velocity=2e-5)
model.insert()
film = Film(model, frames=5)
record = Recorder(path=lambda: model.groupTravelled('top'), stress=lambda: model.groupForce('top') / 0.002)
record.after(lambda row: film.look(row.path / 1e-5, row.stress, O.time))
O.dt, O.engines = 1e-4, loopList(alpha=0.5) + [record.engine(100)]
O.run(5000, True)
out = Path('out/film')
picturesfields.drawField(out / 's1.png', film.peak, 's1') # contours: displacements and stresses
picturesfields.drawJoints(out / 'opening.png', model, 'opening') # bars: sigma, tau, opening, slip
picturesfields.drawCrosses(out / 'crosses.png', film.peak) # principal stresses
picturesfields.drawSheet(out / 'sheet.png', model, title='at the end')
picturesfields.drawReactions(out / 'reactions.png', film.peak)
picturesfields.drawMovie(out / 'film.gif', film.states(), 's1')
pictures.drawCracks(out / 'cracks.png', model)
writeFilm(out, film, Snapshot(model, O.time)) # blocks.pvd, joints.pvd, contacts.pvd
