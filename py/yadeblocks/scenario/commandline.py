# yade-blocks, GPL-2.0-or-later
"""What the user asked for."""
import sys
from pathlib import Path

from .batch import batchLine
from .calibrated import withJoints
from .describing import describe
from .parsing import ParameterError, parse


def parameters(defaults, allowed=None, scenario=None):
	"""What the user asked for: from the command line, below that from the table line in YADE_BATCH, else `defaults`.

	defaults: key -> Key, usually {**commonParameters(), "own": Key(1.0, "what it is", "m")}; allowed: see `parse`; scenario: the name, by default
	that of the script. `help` as an argument shows all keys and leaves. Input that is refused ends the program with code 2."""
	scenario = scenario or Path(sys.argv[0]).stem # yade hands over the script's own argv
	words = sys.argv[1:]
	if "help" in words or "--help" in words:
		print(describe(defaults, allowed, scenario))
		sys.exit(0)
	try:
		words = withJoints(words, scenario)
		given = {word.partition("=")[0] for word in words}
		table = batchLine(set(defaults))
		p = parse(words + [f"{key}={text}" for key, text in table.items() if key not in given], defaults, allowed, scenario)
		_checkThreads(p, "threads" in given or "threads" in table)
		return p
	except ParameterError as error:
		print(error, file=sys.stderr)
		sys.exit(2)


def require(fulfilled, text):
	"""Ends the program with this line and code 2 unless the values go together, which rules of single values cannot say."""
	if not fulfilled:
		print(text, file=sys.stderr)
		sys.exit(2)


def _checkThreads(p, asked):
	"""YADE's number of threads is fixed at its start: what was asked for must agree, else the result shows the true one."""
	if "yade.wrapper" not in sys.modules or not hasattr(p, "threads"):
		return
	running = sys.modules["yade.wrapper"].Omega().numThreads
	if asked and p.threads != running:
		raise ParameterError(f"{p.scenario}.threads must be what YADE was started with (yade -j{p.threads}), got {p.threads} with -j{running}")
	p.threads = running
