# yade-blocks, GPL-2.0-or-later
"""A scenario of one's own: a plate is stretched, against Hooke's law. scripts/run.sh examples/ownscenario [key=value ...]"""
import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import scenario
from yadeblocks.engines import loopList
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import nodesWhere, rectangle

p = scenario.parameters(
	{**scenario.usualParameters(seed=1, seeds=1, tag='', steps=1000, alpha=0.5), 'stroke': Key(1e-6, 'path of the upper edge', 'm', scenario.positive)}
)
with Session(p) as session:
	for seed in p.seedList:
		with session.run(seed) as run:
			O.reset()
			O.materials.append(BlockMat(label='rock', young=20e9, poisson=0.0, density=2500))
			model = BlockModel(thickness=1)
			model.addRegion(rectangle(0, 0, 0.1, 0.1), 'rock', zoneSize=0.05)
			model.bond([])
			model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
			model.drive('top', nodesWhere(model, lambda x, y: y > 0.1 - 1e-9), 'y', velocity=p.stroke / (1e-4 * p.steps))
			model.insert()
			O.dt, O.engines = 1e-4, loopList(alpha=p.alpha)
			O.run(p.steps, True)
			run.add('stress', 'MPa', model.groupForce('top') / 0.1e6, 20e9 * p.stroke / 0.1 / 1e6, "Hooke's law")
			run.model(model, steps=O.iter)
	session.write()
