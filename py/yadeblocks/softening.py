# yade-blocks, GPL-2.0-or-later
"""Sets of properties of joints that soften, and the keys by which the scenarios choose among them. SI units.

	measured     what the laboratory measured and the literature gives, fixed before any run; nothing is fitted

Tensile strength: Van der Pluijm 1992; cohesion, friction, residual friction: Van der Pluijm 1993 (both as in the paper, which gives no energies). Fracture
energies of his tests, as Lourenco 1996 reports them: GfI 5 to 20 N/m for strengths of 0.3 to 0.9 N/mm2, of which the middle is taken; GfII 10 to 250 N/m for
cohesions of 0.1 to 1.8 N/mm2, of which a value in the lower half is taken. Stiffnesses are those of the paper's tables. Opening is lasting, as in the law of
Lourenco and Rots 1997, whose parameters these are."""
import math
from math import atan

from . import experiments, masonry, scenario

measured = dict(
	masonry.stiffnesses, tension=1e6 * experiments.tensileStrength[0], cohesion=1e6 * experiments.shearCohesion, frictionAngle=atan(
		experiments.shearFriction
	), frictionAngleResidual=atan(experiments.residualFriction), GfI=12.0, GfII=60.0, GfIIPressure=0.0, lastingShare=1.0
)

_positive = scenario.Rule(lambda v: v == -1 or 0 < v < math.inf, "must be positive (-1: that of the joints)")
_notNegative = scenario.Rule(lambda v: v == -1 or 0 <= v < math.inf, "must not be negative (-1: that of the joints)")
_share = scenario.Rule(lambda share: share == -1 or 0 <= share <= 1, "must lie in [0, 1] (-1: that of the joints)")
_angle = scenario.Rule(lambda angle: angle == -1 or 0 <= angle < 90, "must lie in [0, 90) degrees (-1: that of the joints)")
_keys = {
	"kn": ("normal stiffness", "Pa/m", _positive),
	"ks": ("shear stiffness", "Pa/m", _positive),
	"cohesion": ("cohesion", "Pa", _notNegative),
	"tension": ("tensile strength", "Pa", _notNegative),
	"friction": ("friction angle", "degrees", _angle),
	"residualFriction": ("friction angle after failure", "degrees", _angle),
	"dilation": ("dilation angle", "degrees", _angle),
	"strengths": ("factor on all strengths", "", _positive),
	"stiffnesses": ("factor on all stiffnesses of joints", "", _positive),
	"unitStrengths": ("factor on the strengths of joints within units", "", _positive),
	"mortarStrengths": ("factor on the strengths of joints of the mortar", "", _positive),
	"unitFriction": ("friction angle of joints within units", "degrees", _angle),
	"mortarFriction": ("friction angle of joints of the mortar", "degrees", _angle),
	"GfI": ("fracture energy in tension", "N/m", _notNegative),
	"GfII": ("fracture energy in shear", "N/m", _notNegative),
	"GfIIPressure": ("what GfII rises by with pressure, N/m by Pa", "m", _notNegative),
	"lastingShare": ("share of a softened joint's opening that stays when it closes", "", _share),
}


def jointKeys(*names):
	"""Scenario keys for properties of the joints, which stand in place of those of the chosen set: `kn ks cohesion tension friction residualFriction
	dilation strengths stiffnesses unitStrengths mortarStrengths unitFriction mortarFriction GfI GfII GfIIPressure lastingShare`."""
	return {name: scenario.Key(-1.0, _keys[name][0], *_keys[name][1:]) for name in names}


def stronger(joint, factor):
	"""Properties of a joint with its strengths times a factor; -1: as they are."""
	return joint if factor == -1 else {**joint, **{name: factor * joint[name] for name in ('cohesion', 'tension')}}


#: Scenario keys of the scatter of strengths.
scatterKeys = {
	"scatter": scenario.Key(
		-1.0, "coefficient of variation of the joints' strengths", "",
		(lambda c: c == -1 or 0 <= c <= 1, "must lie in [0, 1] (-1: that of the joints)")
	),
	"scatterLength": scenario.Key(-1.0, "correlation length of the strengths", "m", _notNegative),
}


def takeScatter(p, scatter=0.0, length=0.0):
	"""Puts the set's scatter where the keys leave it open."""
	if p.scatter == -1: p.scatter = scatter
	if p.scatterLength == -1: p.scatterLength = length


def scatterStrengths(model, p, seed):
	"""The strengths of a model's joints as the keys say; the field's seed is that of the tessellation. Weibull, as strengths of brittle things are."""
	if p.scatter > 0: model.scatterStrengths(cov=p.scatter, correlationLength=p.scatterLength, seed=seed)
