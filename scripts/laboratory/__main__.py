# yade-blocks, GPL-2.0-or-later
"""Studies of many runs: scripts/study.sh ensemble|sensitivity|calibrate|limit NAME [key=value ...]

	ensemble      how the quantities of a scenario scatter over tessellations, and over tables of parameters
	sensitivity   which parameters govern which quantity: one at a time, then Sobol's indices
	calibrate     the parameters with which quantities reach their targets
	limit         what slow time steps come down to, beside the exact path

NAME is a scenario, or the path of one's own. Keys that are not the study's go to the scenario. Interrupted studies continue when called again.
`scripts/study.sh KIND help` shows the study's keys; results are in out/study-KIND-NAME/.
"""
import importlib
import signal
import sys
from pathlib import Path

house = Path(__file__).resolve().parents[2]
kinds = ("ensemble", "sensitivity", "calibrate", "limit")


def main(words):
	from laboratory import command, engine
	if not words or words[0] not in kinds:
		print(__doc__.strip(), file=sys.stderr)
		return 2
	kind = importlib.import_module("laboratory." + words[0])
	if len(words) < 2 or "help" in words[1:]:
		print(f"{kind.__doc__.strip()}\n")
		for key, value in {**command.commonKeys, **kind.keys}.items():
			print(f"  {key + '=' + str(value):<22} {kind.meanings.get(key, command.meanings.get(key, ''))}")
		return 0 if "help" in words[1:] else 2
	try:
		study = command.Command(house, words[0], words[1], words[2:], kind.keys, kind.rules)
		with study.runs:
			kind.study(study)
	except (command.StudyError, engine.EngineError) as error:
		print(error if str(error).startswith("study: ") else f"study: {error}", file=sys.stderr)
		return 1
	except OSError as error:
		print(f"study: {error.filename or ''}: {error.strerror}; what is complete is kept, the same command continues", file=sys.stderr)
		return 1
	except RuntimeError as error: # another study in the same folder, code that changed
		print(f"study: {error}", file=sys.stderr)
		return 1
	except KeyboardInterrupt:
		print("interrupted: what is complete is kept; the same command continues", file=sys.stderr)
		return 130
	return 0


def interrupt(*_):
	raise KeyboardInterrupt


if __name__ == "__main__":
	signal.signal(signal.SIGTERM, interrupt)
	signal.signal(signal.SIGINT, interrupt) # also where the shell has it ignored
	sys.exit(main(sys.argv[1:]))
