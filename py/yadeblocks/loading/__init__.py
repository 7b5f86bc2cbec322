# yade-blocks, GPL-2.0-or-later
"""Loading: rest before it, and when to end it. How it is applied: `BlockModel.drive`, `push`, `traction`, `gravity`,
`elasticJump`, `setThrottle`, and the engine `BlockServo`.

	loading.settle(model)                                    # dead loads and pushed platens, to equilibrium
	stop = loading.Stop(drop=0.5, displacement=3e-3)
	record.after(lambda row: stop(row.displacement, row.stress, row.broken))         # see recording.Recorder

	O.engines = [loading.Motion(model, 'base', loading.accelerogram(times, a)).engine()] + O.engines       # shaken

From event to event, the exact answer of the brittle model, instead of in time steps:

	path = loading.follow(model, 'top', 'seed 1', gauges=[gauge], displacement=1e-3)"""
# flake8: noqa: F401
from .approach import Approach
from .motion import Motion, accelerogram
from .path import follow
from .rest import comesToRest, settle
from .stop import Stop
