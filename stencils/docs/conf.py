# SPDX-License-Identifier: Apache-2.0
"""How Sphinx makes the site. Its pages are gathered by pages.py, which calls this from a folder of the build."""
import os

project = "sublimit"
version = release = os.environ.get("SUBLIMIT_VERSION", "")
copyright = author = "the sublimit authors"
extensions = ["myst_parser"]
myst_heading_anchors = 4  # links to sections, as they are written for readers of the sources
suppress_warnings = ["myst.header"]  # rooms begin with the headings that their readers need
highlight_language = "none"
html_theme = "furo"
html_title = "sublimit " + version
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_show_sphinx = False
html_copy_source = False
html_last_updated_fmt = None
pygments_style = "friendly"
pygments_dark_style = "monokai"
nitpicky = True
