# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphinx's settings of the site for users; scripts/site.py calls it."""
import re
from pathlib import Path

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Operator, String, Text
from sphinx.highlighting import lexers

project = "Conetact"
author = copyright = "Conetact authors"
CMAKE = Path(__file__).resolve().parents[2] / "CMakeLists.txt"
release = version = re.search(r"project\(Conetact VERSION ([\d.]+)", CMAKE.read_text())[1]

extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist"]
myst_heading_anchors = 4
root_doc = "doc/site/index"
exclude_patterns = ["doc/site/**/README.md"]
language = "en"

html_title = f"Conetact {version}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
# MathJax 2 of Debian, relative to _static; formulas are outlines, which need no fonts from a server.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]], "processEscapes": True,
                               "ignoreClass": ".*", "processClass": "math"},
                   "SVG": {"linebreaks": {"automatic": True}}, "messageStyle": "none", "showMathMenu": False}
pygments_style = "friendly"
pygments_dark_style = "monokai"


class SceneLexer(RegexLexer):
    """Colours of scene files: sections, entries and their values, comments."""

    name, aliases = "Scene", ["prm"]
    tokens = {"root": [
        (r"#.*$", Comment),
        (r"^(\s*)(subsection)([^#\n]*)", bygroups(Text, Keyword, Name.Class)),
        (r"^(\s*)(end)(\s*)$", bygroups(Text, Keyword, Text)),
        (r"^(\s*)(include)(\s+)(.*)$", bygroups(Text, Keyword, Text, String)),
        (r"^(\s*)(set)(\s+)([^=\n]+)(=)", bygroups(Text, Keyword, Text, Name.Attribute, Operator)),
        (r"[^#\n]+", String), (r"\n", Text)]}


lexers["prm"] = SceneLexer()
