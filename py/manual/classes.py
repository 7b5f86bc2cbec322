# yade-blocks, GPL-2.0-or-later
"""A page for each of our classes from its docstrings, for Sphinx: yade -n -x py/manual/classes.py FOLDER."""
import re
import sys
from pathlib import Path

names = (
	"BlockModel BlockMat JointMat BlockLoop BlockMotion BlockLaw NumpyLaw BlockServo BlockCrackRecorder BlockContacts BlockTimeStepper BlockForces "
	"BlockIntegrator Ig2_Block_Block_BlockGeom Ip2_BlockMat_BlockMat_JointPhys Law2_BlockGeom_JointPhys_MohrCoulomb"
).split()


def plain(text):
	"""A docstring of YADE without its own roles: links to our classes where there is a page, code elsewhere."""
	def link(match):
		shown, _, target = match.group(1).partition("<")
		name = (target.rstrip(">") or shown).split(".")[0]
		return f":doc:`{shown} <{name}>`" if name in names else f"``{shown}``"

	text = re.sub(r":ydefault:`([^`]*)`", lambda match: f"Default: ``{match.group(1)}``." if match.group(1).strip(' "') else "", text or "")
	text = re.sub(r":yattrtype:`([^`]*)`|:yattrflags:`[^`]*`", "", text)
	text = re.sub(r":yref:`([^`]*)`", link, text)
	parts = re.split(r"(``.+?``|:doc:`[^`]*`)", text) # the odd ones mean something to Sphinx, the others are words
	parts[::2] = [re.sub(r"([|*`])|(?<=\w)_(?!\w)", lambda match: "\\" + match.group(0), part) for part in parts[::2]]
	return " ".join("".join(parts).split())


def signature(name, text):
	"""Arguments and the words of a method's docstring as Boost writes it."""
	head, _, words = text.strip().partition(" :\n")
	if not words: return f"{name}(...)", text
	if head.startswith("object "): # a function of any arguments says itself which
		head, _, words = words.strip().partition("): ")
		return head + ")", words
	arguments, _, result = head.partition("->")
	arguments = re.sub(r"\((\w+)\)arg1,? ?|\[, |[\[\]]", lambda match: ", " if match.group(0) == "[, " else "", arguments)
	arguments = re.sub(r"\((\w+)\)(\w+)", r"\2", arguments).replace("( , ", "(").replace("( ", "(").replace(" ,", ",").strip()
	return " ".join(f"{arguments} -> {result.strip()}".split()), words


def page(kind):
	"""The page of a class as reStructuredText."""
	lines = [kind.__name__, "=" * len(kind.__name__), "", plain(kind.__doc__), ""]
	base = next((base.__name__ for base in kind.__mro__[1:] if base.__name__ in names), None)
	if base: lines += [f"What :doc:`{base}` has, it has, too.", ""]
	own = {name: member for name, member in vars(kind).items() if not name.startswith("_")}
	attributes = {name: member for name, member in own.items() if isinstance(member, property)}
	for title, members in (("Attributes", attributes), ("Methods", {name: member for name, member in own.items() if callable(member) and member.__doc__})):
		if members: lines += [title, "-" * len(title), ""]
		for name in sorted(members):
			head, words = (name, members[name].__doc__) if title == "Attributes" else signature(name, members[name].__doc__)
			lines += [f"``{head}``", "   " + (plain(words) or "(inherited)"), ""]
	return "\n".join(lines)


def write(folder):
	"""All pages and their list."""
	import yade.wrapper as known
	folder = Path(folder)
	folder.mkdir(parents=True, exist_ok=True)
	for name in names:
		(folder / f"{name}.rst").write_text(page(getattr(known, name)))
	listed = "\n".join(f"   {name}" for name in names)
	(folder / "index.rst").write_text(f"Classes\n=======\n\nFrom their docstrings; SI units.\n\n.. toctree::\n   :maxdepth: 1\n\n{listed}\n")


if __name__ == "__main__" and len(sys.argv) > 1:
	import yadeblocks # noqa: F401 (loads the plugin)
	write(sys.argv[1])
