# yade-blocks, GPL-2.0-or-later
"""Settings of Sphinx for the manual."""
project, author, copyright = "yade-blocks", "the authors of yade-blocks", "GPL-2.0-or-later"
html_theme = "alabaster" # Debian's own default
html_theme_options = {"description": "Deformable polygonal blocks with joints that break, for YADE", "fixed_sidebar": True, "page_width": "1100px"}
extensions = ["sphinx.ext.mathjax"]
html_show_sphinx = html_copy_source = False
highlight_language = "python3"
