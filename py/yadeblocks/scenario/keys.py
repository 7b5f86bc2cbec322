# yade-blocks, GPL-2.0-or-later
"""Keys: defaults, meanings, units and rules."""
import math
from collections import namedtuple

#: What a value must fulfil: `test(value)` is true (a NaN must fail it), said in words by `text` ("must be positive").
Rule = namedtuple("Rule", "test text")


def choice(*values):
	"""The rule that a value is one of these."""
	return Rule(lambda value: value in values, "must be one of " + ", ".join(map(str, values)))


positive = Rule(lambda x: 0 < x < math.inf, "must be positive")
notNegative = Rule(lambda x: 0 <= x < math.inf, "must not be negative")
atLeastOne = Rule(lambda n: n >= 1, "must be at least 1")
#: A key of a scenario: its default, what it means, its unit ("" for numbers and words) and its rule: a Rule, a pair (test, text), a tuple of choices, or
#: None where every value of the default's type will do.
Key = namedtuple("Key", "default meaning unit rule", defaults=("", None))


def asRule(rule):
	"""A Rule, whatever short form was given; None stays None."""
	if rule is None or isinstance(rule, Rule): return rule
	return Rule(*rule) if callable(rule[0]) else choice(*rule)
