# yade-blocks, GPL-2.0-or-later
"""What is said where our classes are called with a wrong type, a word that is not known or too few arguments: a sentence with name, rule and value, in
place of Boost's list of C++ signatures. Attributes that do not exist are refused, which Boost would add in silence.

Nothing is looked at unless a call has failed already: calls that are right cost nothing but one function of Python's. Functions in
Python have a door (_door)."""
import functools
import inspect
import re

from ._arguments import Shown, errorOf, signature
from ._kinds import fits, wordsOf
from ._words import closest

_ours = re.compile(r"(Block\w*|JointMat|JointPhys|NumpyLaw|(Ig2|Ip2|Law2|Bo1)_Block\w*)$")


def install(wrapper):
	"""Puts itself in front of the methods of our classes in yade.wrapper; once."""
	for kind in [kind for name, kind in vars(wrapper).items() if _ours.match(name) and isinstance(kind, type)]:
		if "__setattr__" in vars(kind): continue # a class that knows itself what to do
		for name, member in list(vars(kind).items()):
			if type(member).__name__ == "function" and type(member).__module__ == "Boost.Python" and not name.startswith("_"):
				setattr(kind, name, _explained(kind, name, member))
		kind.__init__ = _made(kind, kind.__init__)
		kind.__setattr__, kind.__getattr__ = _set, _absent


def _explained(kind, name, method):
	parameters = _parameters(name, method.__doc__ or "")

	@functools.wraps(method, assigned=("__doc__", ), updated=())
	def call(self, *given, **named):
		try:
			return method(self, *given, **named)
		except TypeError as error:
			if type(error).__name__ != "ArgumentError": raise
			said = errorOf(f"{kind.__name__}.{name}", parameters, given, named)
		if said is None and parameters is not None: # numpy's whole numbers and single precision, which Boost does not know
			try:
				return method(self, *map(_plain, given), **{word: _plain(value) for word, value in named.items()})
			except TypeError as error:
				if type(error).__name__ != "ArgumentError": raise
		raise said or TypeError(f"{kind.__name__}.{name} was called with what it does not take; it is {kind.__name__}.{name}{signature(parameters)}")

	del call.__wrapped__ # inspect would ask Boost, which has no answer
	call.__name__, call.__qualname__ = name, f"{kind.__name__}.{name}"
	if parameters is not None:
		call.__signature__ = inspect.Signature(
			[inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)] +
			[inspect.Parameter(word, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=default) for word, _, default in parameters]
		)
	return call


def _parameters(name, doc):
	"""Name, type and default (a text) of each argument behind the first, from the signature that Boost writes into a docstring; None without one."""
	head = re.match(rf"\s*{name}\( \(\w+\)arg1(.*?)\]*\) -> [\w ]+ ?:?\n", doc, re.S)
	if not head: return None
	found = re.findall(r"\((\w+)\)(\w+)(?:=((?:'[^']*'|[^\[\]]|\[\])*?))?(?=,? ?\[,|, \(|\s*$)", head.group(1))
	return [(word, kind, Shown(default) if default else inspect.Parameter.empty) for kind, word, default in found]


def _plain(value):
	"""A number of numpy's as Python's."""
	return value.item() if hasattr(value, "item") and getattr(value, "ndim", 1) == 0 else value


def _attributes(kind):
	return [name for name in dir(kind) if not name.startswith("_") and isinstance(getattr(kind, name), property)]


def _made(kind, initialise):
	@functools.wraps(initialise, assigned=("__doc__", ), updated=())
	def make(self, *given, **named):
		for word, value in named.items(): # Boost takes a text for a list of its letters
			if isinstance(value, str) and _isList(type(self), word): raise TypeError(f"{type(self).__name__}.{word} must be a list, got {value!r}")
		try:
			return initialise(self, *given, **named)
		except (TypeError, AttributeError) as error:
			said = _ofAttributes(type(self), named, error)
			if said is None: raise
		raise said

	return make


@functools.lru_cache(maxsize=None)
def _isList(kind, word):
	return isinstance(getattr(kind, word, None), property) and isinstance(getattr(kind(), word), list)


def _ofAttributes(kind, named, error):
	"""The error to raise where keyword arguments of a class failed, or None."""
	known = _attributes(kind)
	for word in named:
		if word not in known and f" {word}." in str(error):
			return AttributeError(f"{kind.__name__} has no attribute {word}{closest(word, known)}; known: {' '.join(known)}")
	if "No registered converter" not in str(error): return None
	wrong = re.search(r"of type (.+) from this Python object of type (.+)$", str(error))
	type_, got = {"double": "float", "std::string": "str", "long": "int"}.get(wrong.group(1), wrong.group(1)), wrong.group(2)
	if "basic_string" in type_: type_ = "str"
	plain = kind()
	words = [
		word for word, value in named.items()
		if type(value).__name__ == got and not fits(value, type_) and type(getattr(plain, word, None)).__name__ in (type_, "NoneType")
	]
	if words: return TypeError(f"{kind.__name__}.{words[0]} must be {wordsOf(type_)}, got {named[words[0]]!r}")
	words = [word for word, value in named.items() if _isList(kind, word)]
	if words: return TypeError(f"{kind.__name__}.{words[0]} must be a list, each of it {wordsOf(type_)}, got {named[words[0]]!r}")
	return None


def _absent(self, name):
	"""What is said where an attribute or a method that is not there is read."""
	kind = type(self)
	known = [word for word in dir(kind) if not word.startswith("_")]
	raise AttributeError(f"{kind.__name__} has no attribute {name}{closest(name, known)}")


def _set(self, name, value):
	kind = type(self)
	if isinstance(value, str) and isinstance(getattr(kind, name, None), property) and isinstance(getattr(self, name), list):
		raise TypeError(f"{kind.__name__}.{name} must be a list, got {value!r}")
	if name.startswith("__") or hasattr(kind, name):
		try:
			return object.__setattr__(self, name, value)
		except AttributeError as error:
			if "no setter" not in str(error): raise
			within = f"; write into it: {name}[...] = ..." if name in ("displacement", "velocity") else ""
			raise AttributeError(f"{kind.__name__}.{name} cannot be set{within}") from None
		except TypeError as error:
			if type(error).__name__ != "ArgumentError": raise
			present = getattr(self, name)
		raise TypeError(f"{kind.__name__}.{name} must be {wordsOf(type(present).__name__)}, got {value!r}")
	raise AttributeError(f"{kind.__name__} has no attribute {name}{closest(name, _attributes(kind))}; known: {' '.join(_attributes(kind))}")
