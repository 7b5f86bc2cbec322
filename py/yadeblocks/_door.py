# yade-blocks, GPL-2.0-or-later
"""A door for functions in Python, which would fail somewhere within where they are called with a wrong type, a word that is not known or too few arguments.
It looks at every call, and so is for doors alone. Kinds of arguments stand in _kinds."""
import functools
import inspect

from ._arguments import errorOf


def door(*numbers, **kinds):
	"""For public functions and __init__: unknown keywords, what is left out or given twice, and arguments of a wrong kind (None is right where that is the
	default): a sentence, before anything is done. numbers: names of arguments that are finite numbers; kinds: kinds of others by name, see _kinds. What
	is known is the function's `door`: name, kind and default of each argument.

	TypeError; ValueError for numbers that are not finite, or not whole, where they must be."""
	def wrap(function):
		name = function.__qualname__.removesuffix(".__init__")
		own = [p for p in inspect.signature(function).parameters.values() if p.name != "self"]
		of = {**dict.fromkeys(numbers, "finite"), **kinds}
		parameters = [(p.name, of.get(p.name, ""), p.default) for p in own if p.kind == p.POSITIONAL_OR_KEYWORD]
		missing = set(of) - {word for word, _, _ in parameters}
		if missing: raise ValueError(f"{name} has no arguments {missing}")
		others = any(p.kind == p.VAR_KEYWORD for p in own)
		method = len(own) < len(inspect.signature(function).parameters)
		many = any(p.kind == p.VAR_POSITIONAL for p in own)

		@functools.wraps(function)
		def call(*given, **named):
			known = {word: value for word, value in named.items() if not others or word in {word for word, _, _ in parameters}}
			said = errorOf(name, parameters, given[method:method + len(parameters)] if many else given[method:], known)
			if said: raise said
			return function(*given, **named)

		call.door = parameters
		return call

	return wrap
