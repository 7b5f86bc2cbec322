# yade-blocks, GPL-2.0-or-later
"""Every link, picture and place within the built pages must be there: links.py FOLDER prints those that are not."""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote


class _Page(HTMLParser):
	"""Targets and names of a page."""
	def __init__(self, text):
		super().__init__()
		self.targets, self.fetched, self.names = [], [], set()
		self.feed(text)

	def handle_starttag(self, tag, attributes):
		given = dict(attributes)
		self.names.update(given[key] for key in ("id", "name") if given.get(key))
		self.targets += [given[key] for key in ("href", "xlink:href") if given.get(key) and tag != "link"]
		self.fetched += [given[key] for key in ("src", "href") if given.get(key) and (tag == "link" or key == "src")]


def broken(folder):
	"""Links of the pages in a folder that lead nowhere, as text; what a page must fetch from elsewhere counts, links that a reader follows do not."""
	pages = {path.resolve(): _Page(path.read_text()) for path in Path(folder).rglob("*.html")}
	found, outside = [], ("http:", "https:", "//")
	for path, page in pages.items():
		found += [f"{path.name}: {target} is fetched from elsewhere" for target in page.fetched if target.startswith(outside)]
		for target in page.targets + page.fetched:
			if target.startswith((*outside, "mailto:", "data:")): continue
			place, _, name = unquote(target).partition("#")
			other = (path.parent / place).resolve() if place else path
			if not other.exists() or name and name not in getattr(pages.get(other), "names", ()): found.append(f"{path.name}: {target}")
	return found


if __name__ == "__main__":
	lost = broken(sys.argv[1])
	print(*lost, sep="\n", end="\n" * bool(lost))
	sys.exit(bool(lost))
