# yade-blocks, GPL-2.0-or-later
"""Colours: Okabe and Ito's, which colour-blind readers and grey prints keep apart, and what is drawn in which."""
from itertools import cycle

blue, vermillion, green, purple, black = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000"
jointColours = {"mortar-mortar": blue, "unit-mortar": vermillion, "unit-unit": black, "bed": vermillion, "head": blue, "unit": black, "platen": green}
blockTones = {"unit": "#EBD3C3", "mortar": "#F6F3EA", "platen": "#C9CDD2"}
spareColours = (green, purple, "#56B4E9", "#E69F00")
spareTones = ("#DDE6DF", "#E3DDEA", "#EFE3C2", "#D6E4EE")

tensionRed, pressureBlue = "#B2182B", "#2166AC" # also at the ends of the colour map


def assigned(names, known, spare):
	"""A colour for each name: the known one, else one of the spares in turn."""
	rest = cycle(spare)
	return {name: known[name] if name in known else next(rest) for name in names}
