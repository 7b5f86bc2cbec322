# yade-blocks, GPL-2.0-or-later
"""What the laboratory and the paper measured, in N/mm2 = MPa if nothing else is said, and what theory says where there is no measurement. Each value
stands here and nowhere else; materials and sizes of the specimens stand in `masonry`.

	experiments.expected("shear", sigma=0.5e6)["peak_shear_stress"]     # (1.375, "Van der Pluijm 1993: 0.87 + 1.01 sigma")
"""
from .masonry import table2
from .masonry import tensionCouplet as couplet

tensileStrength = 0.35, "Van der Pluijm 1992" # direct tension of couplets, 1:1:6 mortar
tensileStrengthOfPaper = {2e-3: (0.35, "paper, Fig. 10"), 6e-3: (0.43, "paper, Fig. 10")} # by mean edge of the blocks [m]
shearCohesion, shearFriction, residualFriction = 0.87, 1.01, 0.73 # [MPa], tangents; shear of couplets, 1:2:9 mortar, Van der Pluijm 1993
compressiveStrength = 27.5, "Oliveira 2003" # of a prism
youngsModulus = 4100., "Oliveira 2003"
compressiveFractureEnergy = 23., "Oliveira 2003, as in Table 6" # stress times shortening behind the peak [N/mm]
#: Shear wall J4D with 0.30 N/mm2: its largest force [kN], as digitised; the two readings of it; displacement of the top [mm] and force [kN].
wallForce = 57., "Raijmakers and Vermeltfoort 1992, as digitised; +- 8; another reading is 50"
wallForceReadings = 50, 57
wallCurve = (0, 0.2, 0.4, 0.7, 1.0, 1.4, 1.8, 2.2, 2.6, 3.0), (0, 18, 34, 48, 57, 54, 48, 42, 38, 35)


def peakShearStress(sigma):
	"""Under a precompression sigma [Pa]: (value [MPa], source)."""
	return shearCohesion + shearFriction * sigma / 1e6, "Van der Pluijm 1993: 0.87 + 1.01 sigma"


def residualShearStress(sigma):
	"""Under a precompression sigma [Pa]: (value [MPa], source); None without precompression, where there is nothing to compare with."""
	return residualFriction * sigma / 1e6 or None, "Van der Pluijm 1993: 0.73 sigma"


edgeToSide = 1.61 # square root of the mean area by mean edge of Voronoi blocks


def seriesStiffness(height, young, poisson, kn, side, planeStrain=True):
	"""Stiffness per area across a mortar layer of Voronoi blocks between two stiff faces [Pa/m]: its mortar, the joints within and
	one more at the face in series.

	height [m]; young [Pa]; kn [Pa/m]: of all joints; side: square root of the mean area of a block [m]. Within 5 % of what the couplet in tension
	has before it breaks."""
	modulus = young / (1 - poisson**2 if planeStrain else 1)
	return 1 / (height / modulus + height / (0.92 * kn * side) + 1 / kn)


def expected(experiment, sigma=0.0):
	"""What should come out of "tension", "shear" or "compression": {name of the quantity: (value, source)}; sigma: precompression [Pa].

	The stiffness across the joint in tension is theory, for blocks with edges of 2 mm; a scenario with others says so itself."""
	if experiment == "tension":
		stiffness = seriesStiffness(couplet.mortarHeight, couplet.mortar["young"], couplet.mortar["poisson"], table2["kn"], edgeToSide * 2e-3)
		return {"peak_tensile_stress": tensileStrength, "joint_stiffness": (stiffness / 1e9, "series of mortar and joints")}
	if experiment == "shear":
		return {"peak_shear_stress": peakShearStress(sigma), "residual_shear_stress": residualShearStress(sigma)}
	return {"compressive_strength": compressiveStrength, "youngs_modulus": youngsModulus}
