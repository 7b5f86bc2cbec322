# yade-blocks, GPL-2.0-or-later
"""Settings of Sphinx for the manual."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent)) # mathsvg

project, author, copyright = "yade-blocks", "the authors of yade-blocks", "the authors of yade-blocks, GPL-2.0-or-later"
html_theme = "alabaster" # Debian's own default
html_theme_options = {
	"description": "Deformable polygonal blocks with joints that break, for YADE", "fixed_sidebar": True, "page_width": "min(1400px, 98%)",
	"body_max_width": "none"
}
extensions = ["myst_parser", "mathsvg"]
myst_enable_extensions = ["dollarmath"]
html_math_renderer = "svg" # offline
html_show_sphinx = html_copy_source = False
highlight_language = "python3"
html_static_path = ["custom.css"] # which the theme looks for: code is wrapped, not cut off
exclude_patterns = ["examples"]
