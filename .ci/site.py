"""What the site of mkdocs.yml needs beyond the pages: the layout of the checkout and the reference."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import Any

import griffe

ROOT = Path(__file__).parent.parent
SHOWN = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff", "LICENSE", "docs", "problems", "models")
ROW = re.compile(r"^\| ([^|]+) \| ((?:`\w+`)[^|]*) \|$", re.MULTILINE)
STAGE = tempfile.TemporaryDirectory(prefix="synergrip-site-")
"""Where the site is built from; gone at the end."""


class Examples(griffe.Extension):
    """Docstrings say "Example:" where the reader of Google's style knows a section of code only by "Examples:"."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Name the section as it is known."""
        if obj.docstring:
            obj.docstring.value = re.sub(r"^Example:$", "Examples:", obj.docstring.value, flags=re.MULTILINE)


def on_config(config: Any) -> Any:
    """Build from a folder that shows a part of the checkout, so that links lead where they lead in the checkout."""
    for name in SHOWN:
        if not (shown := Path(STAGE.name) / name).exists():
            shown.symlink_to(ROOT / name)
    config.docs_dir = STAGE.name
    return config


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Put the public names, by the groups of their table, into the reference."""
    if page.file.src_uri != "docs/reference.md":
        return markdown
    table = (ROOT / "docs" / "in-code.md").read_text(encoding="utf-8").partition("## Names")[2]
    groups = []
    for group, names in ROW.findall(table):
        entries = [f"::: synergrip.{name}\n" for name in re.findall(r"`(\w+)`", names)]
        groups.append("\n".join([f"## {group.capitalize()}\n", *entries]))
    return markdown.replace("<!-- names -->", "\n".join(groups))
