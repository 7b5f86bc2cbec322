# yade-blocks, GPL-2.0-or-later
"""Formulas as pictures in the pages themselves, drawn by matplotlib: a manual that is read offline, without LaTeX and without scripts from elsewhere."""
import io
import re

from docutils import nodes
from matplotlib import rc_context
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser

_size = 12.5 # of the text [pt]


def _lines(formula):
	"""A formula for matplotlib, which reads one line."""
	return "$" + " ".join(formula.replace(r"\leq", r"\leq ").split()) + "$"


def svg(formula, size=_size):
	"""An <svg> element whose baseline is that of the text around it; ValueError for a formula that cannot be drawn."""
	text = _lines(formula)
	with rc_context({"mathtext.fontset": "dejavuserif", "svg.fonttype": "path", "svg.hashsalt": "manual"}):
		width, height, depth, *_ = MathTextParser("path").parse(text, dpi=72, prop=_font(size))
		width, height, depth = (value + 1 for value in (width, height, depth))
		figure = Figure(figsize=(width / 72, (height + depth) / 72))
		FigureCanvasSVG(figure)
		figure.patch.set_visible(False)
		figure.text(0.5 / width, depth / (height + depth), text, fontsize=size, va="baseline")
		drawn = io.StringIO()
		figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": None})
	found = re.search(r"<svg.*</svg>", drawn.getvalue(), re.S).group(0)
	found = re.sub(r"<metadata>.*?</metadata>", "", found, flags=re.S)
	return found.replace("<svg ", f'<svg role="img" aria-label="{_escaped(formula)}" style="vertical-align: {-depth / size:.3f}em" ', 1)


def _font(size):
	from matplotlib.font_manager import FontProperties
	return FontProperties(size=size)


def _escaped(text):
	return " ".join(text.split()).replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;").replace(">", "&gt;")


def _inline(writer, node):
	writer.body.append(_unique(writer, svg(node.astext())))
	raise nodes.SkipNode


def _display(writer, node):
	writer.body.append(f'<p class="formula" style="text-align: center">{_unique(writer, svg(node.astext(), 1.15 * _size))}</p>\n')
	raise nodes.SkipNode


def _unique(writer, drawn):
	"""Names of glyphs that occur once in a page."""
	writer.formulas = getattr(writer, "formulas", 0) + 1
	prefix = f"f{writer.formulas}-"
	return re.sub(r'(id="|href="#|url\(#)', lambda match: match.group(1) + prefix, drawn)


def setup(app):
	"""What Sphinx calls."""
	app.add_html_math_renderer("svg", (_inline, None), (_display, None))
	return {"parallel_read_safe": True}
