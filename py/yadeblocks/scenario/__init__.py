# yade-blocks, GPL-2.0-or-later
"""What a scenario is told: `scripts/run.sh NAME key=value ...`, or a line of a yade-batch table. All values in SI units.

	p = scenario.parameters({
		**scenario.commonParameters(size=2e-3, seeds=5), **scenario.usualParameters(jump=True),
		"case": Key("TT1", "which tables the joints follow", rule=("TT1", "TT2")),
		"stroke": Key(0.03e-3, "path of the top", "m", scenario.positive)})
	p.case, p.size, p.seedList, p.folder     # "TT1", 0.002, [1, 2, 3, 4, 5], Path("out/tension")

Every value is checked here, once. What is refused leaves one line on stderr and exit code 2. `help` shows what the Keys say."""
# flake8: noqa: F401
from .batch import waitIfBatch
from .calibrated import jointsFrom, withJoints
from .commandline import parameters, require
from .describing import describe
from .keys import Key, Rule, atLeastOne, choice, notNegative, positive
from .parsing import ParameterError, Parameters, parse
from .usual import commonParameters, usualParameters
