# yade-blocks, GPL-2.0-or-later
"""Words that are not known."""
import difflib


def closest(word, known):
	"""What is said behind a word that is like one of those that are known: (did you mean ...?); else nothing."""
	names = {name.lower(): name for name in known}
	close = difflib.get_close_matches(word.lower(), names, 1)
	return f" (did you mean {names[close[0]]}?)" if close else ""


def requireOneOf(name, value, choices):
	"""ValueError for a word that is none of these."""
	if value not in choices: raise ValueError(f"{name} must be one of {', '.join(choices)}, got {value!r}")
