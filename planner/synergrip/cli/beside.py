"""What is told beside the answer, on standard error: how far a long work is, and what was not written.

Where one JSON document is asked for nothing is: what the answer lacks is a note of the document.
"""

from __future__ import annotations

import sys

from synergrip.cli import ending
from synergrip.cli.streams import columns

_notes: list[str] = []
_line = ""


def begin() -> None:
    """Begin a verb."""
    _notes.clear()


def notes() -> tuple[str, ...]:
    """Return what the document is to note."""
    return tuple(_notes)


def tell(message: str) -> None:
    """Tell how far a long work is."""
    if ending.asks_document():
        return
    if sys.stderr.isatty():
        from synergrip.reports.text.screen import Screen, shown_on
        from synergrip.reports.text.tables import fitted

        with shown_on(Screen(columns(sys.stderr))):
            message = fitted(message)
    print(message, file=sys.stderr, flush=True)


def aside(message: str) -> None:
    """Say what an answer lacks, on standard error or as a note of the document."""
    if ending.asks_document():
        _notes.append(message)
    else:
        tell(message)


def over(message: str) -> None:
    """Write over the last line of a terminal that this wrote, and wipe it with ""; without escapes."""
    global _line
    if ending.asks_document() or not (message or _line) or not sys.stderr.isatty():
        return
    shown = message[: columns(sys.stderr) - 1]
    wiped = " " * (len(_line) - len(shown))
    print(f"\r{shown}{wiped}" + "\r" * (not shown), end="", file=sys.stderr, flush=True)
    _line = shown
