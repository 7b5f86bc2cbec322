# yade-blocks, GPL-2.0-or-later
"""Stones from a drawing: a table of corners here; DXF and SVG are read by the same call."""
from pathlib import Path

from yadeblocks import outlines

drawing = Path('out/drawing/stones.csv')
drawing.parent.mkdir(parents=True, exist_ok=True)
drawing.write_text('0,0,left\n1000,0,left\n1000,500,left\n0,500,left\n\n1000,0,right\n1800,0,right\n1000,500,right\n')
for name, ring in outlines.read(drawing, unit=1e-3): # the drawing is in millimetres
	print(name, len(ring), 'corners')
