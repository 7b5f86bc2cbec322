# yade-blocks, GPL-2.0-or-later
"""A prism of rock, pressed until it breaks: scripts/run.sh examples/first leaves a curve, a picture and files for ParaView in out/first. About 3 s."""
from pathlib import Path

import pandas

import yadeblocks # noqa: F401 (loads the plugin, no root needed)
from yade import *
from yadeblocks import loading, pictures
from yadeblocks.export import writeFilm
from yadeblocks.recording import Recorder
from yadeblocks.results import Cracks
from yadeblocks.snapshot import Film, Snapshot
from yadeblocks.specimen import nodesWhere, rectangle

# ---- blocks and joints (SI units)
O.materials.append(BlockMat(label='rock', young=20e9, poisson=0.2, density=2500))
model = BlockModel(thickness=1) # out of the plane [m]
model.addVoronoi(rectangle(0, 0, 0.05, 0.1), 'rock', size=0.007, seed=1)
model.bond([JointMat(material1='rock', material2='rock', kn=2e12, ks=1e12, cohesion=10e6, tension=5e6, frictionAngle=0.6)]) # where edges meet

# ---- how it is loaded: groups of grid points
model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy') # held
model.drive('top', nodesWhere(model, lambda x, y: y > 0.1 - 1e-9), 'y', velocity=-4e-3, rampTime=0.01) # driven down [m/s]
model.insert() # one Body a block, one Interaction a pair

# ---- what a time step does, and what is read every 50 steps
cracks, film, stop = Cracks(model), Film(model, frames=5), loading.Stop(drop=0.6, displacement=0.8e-3)
record = Recorder(shortening=lambda: -model.groupTravelled('top'), stress=lambda: -model.groupForce('top') / 0.05, broken=cracks.look)
record.after(lambda row: film.look(row.shortening / 0.8e-3, row.stress, O.time))
record.after(lambda row: stop(row.shortening, row.stress, row.broken))
O.dt = 1e-5 # quasi-static: masses are scaled to suit
O.engines = [
	BlockLoop(contact=True), # joints, contacts, zones, loads -> forces
	BlockMotion(damping='local', alpha=0.3), # masses, groups, motion
	record.engine(50)
]
O.run(20000, True)

# ---- what it leaves
folder = Path('out/first')
folder.mkdir(parents=True, exist_ok=True)
curve = pandas.DataFrame(dict(seed=1, shortening_mm=1e3 * record['shortening'], stress_MPa=record['stress'] / 1e6, broken=record['broken']))
curve.to_csv(folder / 'curve.csv', index=False)
pictures.drawCurve(folder / 'curve.png', curve, 'shortening_mm', 'stress_MPa', ('shortening [mm]', 'stress [N/mm²]'), title='Prism of rock')
pictures.drawCracks(folder / 'cracks.png', model, title='Prism of rock')
writeFilm(folder, film, Snapshot(model, O.time)) # blocks.pvd, joints.pvd
print('strength %.1f N/mm², %d of %d contact points broken; see %s' % (record['stress'].max() / 1e6, record.last.broken, model.contactCount, folder))
