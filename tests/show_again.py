"""Runs pages and puts what their blocks print now where they show something else.

Usage: PYTHONPATH=planner python tests/show_again.py docs/PAGE.md ...
"""

from __future__ import annotations

import contextlib
import sys
import tempfile
from pathlib import Path

from pages import judge_block, ran


def show_again(page: Path) -> int:
    """Return how many blocks show something new; those that differ in times and residuals alone stay as they are."""
    new = []
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for block, printed in ran(page):
            try:
                judge_block(block, printed)
            except AssertionError:
                assert block.shown is not None, f"{page.name} shows nothing of what this prints: {block.text}"
                new.append((block.shown_at, len(block.shown), printed.rstrip("\n") + "\n"))
    text = page.read_text(encoding="utf-8")
    for start, length, printed in reversed(new):
        text = text[:start] + printed + text[start + length :]
    page.write_text(text, encoding="utf-8")
    return len(new)


if __name__ == "__main__":
    for name in sys.argv[1:]:
        print(f"{name}: {show_again(Path(name).resolve())} shown anew")
