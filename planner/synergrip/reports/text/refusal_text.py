"""How refused input looks on the screen, and as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from synergrip.errors import InputError, Issue
from synergrip.reports.text.screen import LEAST, screen

WIDTH, NUMBERED = 100, 7  # characters of a source line that are shown, where there is room; and of its number
LONGEST = 4000  # characters of a message
LONGEST_NAME = 400  # of a key or a file

_RED, _BLUE, _BOLD, _END = "\x1b[31m", "\x1b[34m", "\x1b[1m", "\x1b[0m"


def error_text(error: InputError, color: bool = False) -> str:
    """Return every issue with its place and its source line, and a last line that counts them.

    Args:
        error: what was refused.
        color: True writes colours for a terminal.
    """
    blocks = ["\n".join(_block(issue, color)) for issue in error.issues]
    count = len(blocks)
    files = {issue.file for issue in error.issues if issue.file}
    one = _clean(next(iter(files), ""), LONGEST_NAME)
    where = f" in {one}" if len(files) == 1 else f" in {len(files)} files" if files else ""
    counted = f"{count} error{'s' if count != 1 else ''}{where}; nothing was solved."
    return "\n\n".join([*blocks, f"{counted}      exit code {error.exit_code}"])


def error_json(error: InputError) -> dict[str, Any]:
    """Return the error as one JSON object: the first issue, and all of them under ``errors``."""
    issues = [_plain(issue) for issue in error.issues]
    first = issues[0] if issues else _plain(Issue(str(error)))
    return {"error": {"type": type(error).__name__, **first, "errors": issues}}


def _plain(issue: Issue) -> dict[str, Any]:
    """Return the fields of an issue; null where nothing is known."""
    return {
        "message": issue.message,
        "file": issue.file or None,
        "line": issue.line or None,
        "column": issue.column or None,
        "key": issue.key or None,
    }


def _block(issue: Issue, color: bool) -> Iterator[str]:
    def paint(text: str, code: str) -> str:
        return f"{code}{text}{_END}" if color and text else text

    key = f" {paint(_clean(issue.key, LONGEST_NAME), _BOLD)}" if issue.key else ""
    yield f"{paint('error', _RED)}{key}: {_clean(issue.message)}"
    if issue.file:
        place = f":{issue.line}:{issue.column}" if issue.line else ""
        yield f"  {paint('-->', _BLUE)} {_clean(issue.file, LONGEST_NAME)}{place}"
    if issue.line and issue.source.strip():
        number = f"{issue.line:4} | "
        source, start = _window(issue)
        length = max(min(issue.length, len(source) - start), 1)
        yield f"{paint(number, _BLUE)}{source}"
        yield f"{paint(' ' * (len(number) - 2) + '| ', _BLUE)}{' ' * start}{paint('^' * length, _RED)}"


def _window(issue: Issue) -> tuple[str, int]:
    """Return the part of the source line to show, and where in it the issue begins."""
    source, start = issue.source.rstrip(), max(issue.column - 1, 0)
    width = min(WIDTH, max(screen().width, LEAST) - NUMBERED)
    first = 0 if len(source) <= width or start < width * 2 // 3 else start - width // 3
    shown = source[first : first + width]
    return "".join(
        " " if letter == "\t" else letter if letter.isprintable() else "?" for letter in shown
    ), start - first


def _clean(text: str, longest: int = LONGEST) -> str:
    """Return the text without control characters, which a terminal would obey, and without the middle of a long one."""
    if len(text) > longest:
        text = f"{text[: longest // 2]} ... {text[-longest // 2 :]}"
    return "".join(letter if letter.isprintable() or letter == "\n" else "?" for letter in text)
