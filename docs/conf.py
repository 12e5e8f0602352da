"""How Sphinx builds the documentation: scripts/docs."""

import typing

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

import meshjig
from meshjig.options import PROCESSES, Options

project = "meshjig"
author = "The meshjig developers"
copyright = "The meshjig developers, GPL-3.0-or-later"
version = release = meshjig.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
exclude_patterns = ["build"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 3
suppress_warnings = ["misc.highlighting_failure"]
smartquotes_action = "qe"
html_theme = "furo"
html_title = f"meshjig {version}"
html_static_path = []
autodoc_typehints = "none"  # the docstrings give shapes, dtypes and units, which say more
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_rtype = False


class OptionsTable(SphinxDirective):
    """A row for each field of Options, as the code has it."""

    def run(self) -> list[nodes.Node]:
        """Make the table."""
        rows = ["| keyword | default | meaning |", "|---|---|---|"]
        for name, field in Options.model_fields.items():
            default = field.default
            if name in PROCESSES["fdm"]:
                default = "the process's"
            elif isinstance(default, tuple):
                default = ",".join(default)
            choices = [value for value in typing.get_args(field.annotation) if isinstance(value, str)]
            listed = len(choices) > 1 and not any(choice in field.description for choice in choices[1:])
            meaning = field.description + (f": {', '.join(choices)}" if listed else "")
            rows.append(f"| `{name}` | {'' if default is None else default} | {meaning} |")
        box = nodes.Element()
        self.state.nested_parse(StringList(rows, "options.py"), 0, box)
        return box.children


def setup(app: typing.Any) -> None:
    """Tell Sphinx of the directive."""
    app.add_directive("options-table", OptionsTable)
