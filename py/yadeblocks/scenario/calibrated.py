# yade-blocks, GPL-2.0-or-later
"""Keys and values from a file of calibrated parameters."""
import json
from pathlib import Path

from .parsing import ParameterError


def withJoints(words, scenario):
	"""The words with joints=FILE.json replaced by what the file says (see `jointsFrom`), except for keys that the words give themselves."""
	files = [word for word in words if word.startswith("joints=") and word.endswith(".json")]
	if not files:
		return words
	rest = [word for word in words if word not in files]
	given = {word.partition("=")[0] for word in rest}
	return rest + [f"{key}={value}" for file in files for key, value in jointsFrom(file[7:], scenario).items() if key not in given]


def jointsFrom(file, scenario):
	"""Keys and values for a scenario from a file of calibrated parameters, as scripts/study.sh calibrate writes it:
	{"parameters": {key: value}, "scenarios": {scenario: {key: value}}}; the second, which may be missing, is for that scenario only.
	"joints" among them names the set of joints that the others change. Raises ParameterError for a file that is not of this form."""
	try:
		found = json.loads(Path(file).read_text())
		values = {**found["parameters"], **found.get("scenarios", {}).get(scenario, {})}
	except OSError as error:
		raise ParameterError(f"{scenario}.joints must be a file that can be read, got {file} ({error.strerror})") from None
	except (ValueError, KeyError, TypeError, AttributeError):
		raise ParameterError(f'{scenario}.joints must be a file with {{"parameters": {{key: value}}}}, got {file}') from None
	if not all(isinstance(value, (int, float, str)) for value in values.values()):
		raise ParameterError(f"{scenario}.joints must be a file whose parameters are numbers or words, got {file}")
	return values
