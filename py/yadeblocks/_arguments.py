# yade-blocks, GPL-2.0-or-later
"""What is said of the arguments of a call: a sentence with name, rule and value."""
import inspect

from ._kinds import wrong
from ._words import closest


def errorOf(name, parameters, given, named):
	"""The error to raise for what is wrong with a call, or None.

	parameters: name, kind and default of each argument, or None where they are not known; given, named: what it was called with."""
	if parameters is None: return None
	words = [word for word, _, _ in parameters]
	if len(given) > len(words): return TypeError(f"{name} takes {len(words)} arguments at most, got {len(given)}: {name}{signature(parameters)}")
	for word in named:
		if word not in words: return TypeError(f"{name} has no argument {word}{closest(word, words)}; known: {' '.join(words) or 'none'}")
		if word in words[:len(given)]: return TypeError(f"{name}.{word} must be given once, got {given[words.index(word)]!r} and {named[word]!r}")
	values = {**dict(zip(words, given)), **named}
	missing = [word for word, _, default in parameters if default is inspect.Parameter.empty and word not in values]
	if missing: return TypeError(f"{name} needs {' and '.join(missing)}: {name}{signature(parameters)}")
	for word, kind, default in parameters:
		if word not in values or (values[word] is None and default is None): continue
		said = wrong(f"{name}.{word}", values[word], kind)
		if said: return said
	return None


def signature(parameters):
	"""Arguments as a call shows them, in brackets."""
	return "(" + ", ".join(word if default is inspect.Parameter.empty else f"{word}={default!r}" for word, _, default in parameters or ()) + ")"


class Shown(str):
	"""A default as Boost shows it."""
	def __repr__(self):
		return str(self).strip()
