# yade-blocks, GPL-2.0-or-later
"""What goes on in a specimen: displacements, stresses, joints; one call for a picture, one for all on a sheet.

	drawField(folder / 'stress.png', model, 's1')          # contours of a displacement or a stress, see `fields`
	drawCrosses(folder / 'crosses.png', model)             # principal stresses
	drawJoints(folder / 'slip.png', model, 'slip')         # bars on the joints: sigma, tau, opening or slip
	drawJoints(folder / 'bed.png', model, 'tau', joints='bed')   # of joints of a name alone
	drawNames(folder / 'names.png', model)                 # joints, coloured by name
	drawContacts(folder / 'contacts.png', model)           # edges that touch without a bond, and their forces
	drawReactions(folder / 'reactions.png', model)         # forces of groups and of held rigid blocks
	drawSheet(folder / 'peak.png', film.peak, title='at the peak')
	drawMovie(folder / 'film.gif', film.states(), 's1')    # or film.mp4

`model` is a BlockModel or a Snapshot of one. Shapes are deformed, as in pictures.drawCracks."""
# flake8: noqa: F401
from .pictures.bars import drawJoints, onJoints
from .pictures.contacts import drawContacts
from .pictures.crosses import drawCrosses
from .pictures.field import drawField, fields
from .pictures.movie import drawMovie
from .pictures.names import drawNames
from .pictures.reactions import drawReactions
from .pictures.sheet import drawSheet
