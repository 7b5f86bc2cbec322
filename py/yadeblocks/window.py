# yade-blocks, GPL-2.0-or-later
"""YADE's window on the plane of the blocks.

	from yadeblocks import window
	window.show(colour='sigma1', zones=True)
	window.snapshot('wall.png')

Blocks are drawn by the class Gl1_Block, joints and their stresses by Gl1_BlockGeom and Gl1_JointPhys (`joints=`, `stresses=`); what is said here can also be
set there. Needs YADE started with its window, so without `yade -n`."""
import time

from ._door import door


@door(colour='str', zones='flag', cracks='flag', range='point', joints='flag', stresses='flag')
def show(colour='material', zones=False, cracks=True, range=None, joints=False, stresses=False):
	"""Opens YADE's window, or takes the one that is open, and looks straight on the blocks -> the view, see yade.qt.View.

	colour: of the zones, 'material' (or the colour of a body's shape), 'displacement' [m], a stress [Pa] ('sigma1', 'sigma2', 'sxx', 'syy', 'sxy'; tension
	positive) or 'damage' (the share of a block's joints that is broken); range: values of the ends of the scale, those of the model by default;
	zones, cracks: whether zones' edges and broken joints are drawn; joints, stresses: whether all joints and bars of normal stress are.
	Errors: RuntimeError without a window, ValueError for a colour that is none of these."""
	from yade import O, Vector3
	from yade.wrapper import Gl1_Block
	try:
		from yade import qt
	except ImportError as error:
		raise RuntimeError('there is no window: YADE was started with -n, or there is no display') from error
	Gl1_Block.colour = colour
	Gl1_Block.zones, Gl1_Block.cracks = zones, cracks
	Gl1_Block.range = range if range is not None else (0, 0)
	renderer = qt.Renderer()
	renderer.intrGeom, renderer.intrPhys = joints, stresses
	views = qt.views()
	view = views[0] if views else qt.View()
	_draw()
	view.viewDir, view.upVector = Vector3(0, 0, -1), Vector3(0, 1, 0)
	corners = [corner for body in O.bodies if hasattr(body.shape, 'outline') for corner in body.shape.outline]
	if corners:
		xs, ys = zip(*((corner[0], corner[1]) for corner in corners))
		view.ortho = True
		size = max(max(xs) - min(xs), max(ys) - min(ys))
		margin = 0.05 * size
		view.sceneRadius = size
		view.fitAABB(Vector3(min(xs) - margin, min(ys) - margin, 0), Vector3(max(xs) + margin, max(ys) + margin, 0))
	_draw()
	return view


@door(path='file')
def snapshot(path):
	"""Saves what the window shows as a picture (.png, .jpg) -> its path. Errors: RuntimeError without a window, OSError if the file cannot be written."""
	from PyQt5.QtWidgets import QApplication, QOpenGLWidget
	_draw()
	shown = [widget for widget in QApplication.instance().allWidgets() if isinstance(widget, QOpenGLWidget)] if QApplication.instance() else []
	if not shown: raise RuntimeError('there is no window: call show() first')
	if not shown[0].grabFramebuffer().save(str(path)): raise OSError(f'cannot write the picture {path}')
	return path


def _draw():
	"""Lets the window do what it has to do."""
	from PyQt5.QtWidgets import QApplication
	for _ in range(10):
		QApplication.instance().processEvents()
		time.sleep(0.01)
