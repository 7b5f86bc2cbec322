# yade-blocks, GPL-2.0-or-later
"""The laboratory's masonry: sizes of specimens, materials and joints. Each value stands here and nowhere else; what was measured stands in `experiments`.

	model.bond([JointMat(material1='mortar', material2='mortar', **masonry.table2)])
	O.materials.append(BlockMat(label='unit', **masonry.tensionCouplet.unit))

SI units, angles in radians, thickness out of the plane. Tables are those of the paper; their joints are for JointMat, their materials for BlockMat."""
from collections import namedtuple
from math import atan, radians

#: Bricks, one upon the other, with a layer of mortar between any two; stroke: of the machine at which the scenario ends [m].
Specimen = namedtuple("Specimen", "bricks width brickHeight mortarHeight thickness stroke unit mortar")

# ---- couplets: Van der Pluijm 1992 (tension) and 1993 (shear)

tensionCouplet = Specimen(
	bricks=2, width=0.1, brickHeight=0.05, mortarHeight=0.015, thickness=0.05, stroke=0.03e-3, unit=dict(young=16.7e9, poisson=0.2, density=1900),
	mortar=dict(young=2.974e9, poisson=0.2, density=1250)
) # Table 1
shearCouplet = tensionCouplet._replace(width=0.2, stroke=1e-3, mortar=dict(tensionCouplet.mortar, density=3250)) # Table 4
stiffnesses = dict(kn=400e9, ks=200e9) # of all joints of couplets
table2 = dict(stiffnesses, frictionAngle=radians(38), cohesion=0.75e6, tension=0.75e6, dilationAngle=radians(4)) # within mortar
table3 = dict(table2, cohesion=0.60e6, tension=0.60e6) # between mortar and unit
table5 = dict(stiffnesses, frictionAngle=radians(45), frictionAngleResidual=radians(36), cohesion=3e6, tension=1.5e6)

# ---- prism: Oliveira 2003

prism = Specimen(
	bricks=5, width=0.285, brickHeight=0.05, mortarHeight=0.01, thickness=0.285, stroke=3.6e-3, unit=dict(young=20e9, poisson=0.2, density=2000),
	mortar=dict(young=5.8e9, poisson=0.2, density=2000)
) # Table 7
table8 = dict(kn=348e9, ks=174e9, frictionAngle=radians(15), cohesion=1.4e6, cohesionResidual=0.28e6, tension=0.7e6) # of mortar, also to the unit
#: Joints within bricks without what is left of their cohesion. The couplets take them, for which none are given.
brickJoint = dict(kn=1260e9, ks=630e9, frictionAngle=radians(20), cohesion=15e6, tension=7.5e6)
table9 = dict(brickJoint, cohesionResidual=3e6) # within bricks

# ---- wall J4D: Raijmakers and Vermeltfoort 1992, Lourenco and Rots 1997

#: Length and height of a brick, thickness of the joints and of the wall [m]; the joints' friction coefficient.
Wall = namedtuple("Wall", "length height gap thickness friction unit joint")
j4d = Wall(
	length=0.21, height=0.052, gap=0.01, thickness=0.1, friction=0.75, unit=dict(young=16.7e9, poisson=0.15, density=1900),
	joint=dict(kn=82e9, ks=36e9, tension=0.25e6, cohesion=0.35e6, frictionAngle=atan(0.75), GfI=18., GfII=125.)
)
