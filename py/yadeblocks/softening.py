# yade-blocks, GPL-2.0-or-later
"""Sets of properties of joints that soften, and the keys by which the scenarios choose among them. SI units.

	measured     what the laboratory measured and the literature gives, fixed before any run; nothing is fitted

Tensile strength: Van der Pluijm 1992; cohesion, friction, residual friction: Van der Pluijm 1993 (both as in the paper, which gives no energies). Fracture
energies of his tests, as Lourenco 1996 reports them: GfI 5 to 20 N/m for strengths of 0.3 to 0.9 N/mm2, of which the middle is taken; GfII 10 to 250 N/m for
cohesions of 0.1 to 1.8 N/mm2, of which a value in the lower half is taken. Stiffnesses are those of the paper's tables."""
from math import atan

from . import experiments, scenario

measured = dict(
	kn=400e9, ks=200e9, tension=1e6 * experiments.tensileStrength[0], cohesion=1e6 * experiments.shearCohesion,
	frictionAngle=atan(experiments.shearFriction), frictionAngleResidual=atan(experiments.residualFriction), GfI=12.0, GfII=60.0
)

#: Scenario keys of the scatter of strengths; -1: that of the joints' set.
scatterKeys = {"scatter": -1.0, "scatterLength": -1.0}
scatterRules = {
	"scatter": scenario.Rule(lambda c: c == -1 or 0 <= c <= 1, "must lie in [0, 1] (-1: that of the joints)"),
	"scatterLength": scenario.Rule(lambda s: s == -1 or s >= 0, "must not be negative (-1: that of the joints)"),
}


def takeScatter(p, scatter=0.0, length=0.0):
	"""Puts the set's scatter where the keys leave it open."""
	if p.scatter == -1: p.scatter = scatter
	if p.scatterLength == -1: p.scatterLength = length


def scatterStrengths(model, p, seed):
	"""The strengths of a model's joints as the keys say; the field's seed is that of the tessellation. Weibull, as strengths of brittle things are."""
	if p.scatter > 0: model.scatterStrengths(cov=p.scatter, correlationLength=p.scatterLength, seed=seed)
