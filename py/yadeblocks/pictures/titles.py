# yade-blocks, GPL-2.0-or-later
"""What pictures are called."""

titles = {
	"u": "displacement", "ux": "displacement along x", "uy": "displacement along y", "sxx": "stress sxx", "syy": "stress syy", "sxy": "shear stress sxy",
	"szz": "stress out of the plane szz", "s1": "larger principal stress", "s2": "smaller principal stress", "vonMises": "stress of von Mises",
	"sigma": "normal stress of the joints", "tau": "shear stress of the joints", "opening": "opening of the joints", "slip": "slip of the joints"
}
