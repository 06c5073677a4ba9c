"""TOML and JSON texts as plain values; what is too much to read in a moment is refused before it is read."""

from __future__ import annotations

import json
import re
import tomllib
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from synergrip.documents.positions import Place, Positions, enclosing, positions
from synergrip.errors import InputError, Issue

LARGEST_TOML = 1_000_000
"""Characters: Python reads about a million of them in a second."""
MOST_VALUES = 50_000
"""Keys and values of a file that people write: 200 synergies of 200 joints, and room for more."""
MOST_NUMBERS = 2_000_000
"""Values of a JSON file that programs write: a grasp as matrices, or a plan."""
MOST_LISTS = 500_000
"""Lists and tables in such a file."""
LONGEST_KEY = 64
"""Parts of a dotted key; the time that TOML takes grows with their square."""
LARGEST_PLACED, MOST_PLACED = 4_000_000, 20_000
"""Characters, keys and values of a text whose places are told by line and column, not by key alone."""

_DIGITS = re.compile(r"[0-9][0-9_]*")
_MOST_DIGITS = 4300  # that Python converts
_MANY_DIGITS, _WORDY = 1200, 100
"""Digits that no number has when doubles are written out; characters per value from which on they are looked for."""
_REPEATED = re.compile(r"overwrite|twice|duplicate|mutate", re.IGNORECASE)
_LONG_HEADER = 200
"""Characters of a line that may still belong to the table header at whose beginning TOML finds a fault."""
_TOML_PLACE = re.compile(r"\(at (?:line (\d+), column (\d+)|end of document)\)\s*\Z")
_LONG_KEY = re.compile(rf"""(?<![\w"'-])(?:(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*\.[ \t]*){{{LONGEST_KEY}}}""")


def loads(path: Path, text: str, kind: str, numbers: bool = False) -> tuple[dict[str, Any], str]:
    """Return the table of a TOML or JSON text, and a key that stands twice in it, if any.

    Args:
        path: of the file; its suffix tells the syntax.
        text: of the file.
        kind: what it is to the user, for messages.
        numbers: whether it may be long because a program wrote it.

    Raises:
        InputError: no such syntax, or too much of it; with the place.
        RecursionError: lists and tables too deep in each other.
        ValueError: a number of too many digits, see `too_long`.
    """
    if path.suffix.lower() == ".toml":
        _check_toml(path, text, kind)
        return _loads_toml(path, text), ""
    values, lists = _amount(text), text.count("[") + text.count("{")
    if numbers and (values > MOST_NUMBERS or lists > MOST_LISTS or text.count(":") > MOST_VALUES):
        raise _too_much(path, f"holds more than {MOST_NUMBERS:,} numbers, {MOST_LISTS:,} lists or {MOST_VALUES:,} keys")
    if not numbers and values > MOST_VALUES:
        raise _too_much(path, _more(kind))
    if len(text) > _WORDY * max(values, MOST_VALUES):  # digits in such numbers take more than a moment to convert
        _check_digits(path, text)
    return _loads_json(path, text)


def is_placed(text: str) -> bool:
    """Tell whether it takes no longer than a moment to find every key of the text."""
    return len(text) <= LARGEST_PLACED and _amount(text) <= MOST_PLACED


def at(path: Path, lines: Sequence[str], issue: Issue, line: int, column: int, length: int = 1) -> Issue:
    """Return the issue with its place, and the source line to show."""
    source = lines[line - 1] if line <= len(lines) else ""
    return replace(issue, file=str(path), line=line, column=column, length=length, source=source)


def too_long(path: Path, text: str) -> InputError:
    """Return the error at the first number that has more digits than Python converts."""
    runs = (match.start() for match in _DIGITS.finditer(text) if match.end() - match.start() > _MOST_DIGITS)
    return _endless(path, text, next(runs, 0))


def duplicates(path: Path, lines: Sequence[str], found: Positions, most: int) -> list[Issue]:
    """Return an issue for each key that stands twice."""

    def issue(key: str, first: Place, second: Place) -> Issue:
        span = second.key or second.value
        name = key[len(enclosing(key)) :].lstrip(".")
        message = f"key '{name}' is written twice (first in line {(first.key or first.value).line})"
        return at(path, lines, Issue(message, key=key, on_key=True), span.line, span.column, span.length)

    return [issue(*duplicate) for duplicate in found.duplicates[:most]]


def check_keys(text: str) -> None:
    """Raise a `RecursionError` for a dotted key of more parts than tables may be deep."""
    if _LONG_KEY.search(text):
        raise RecursionError


def _amount(text: str) -> int:
    """Return a bound on the number of keys and values in a text."""
    return text.count(",") + text.count("[") + text.count("{") + max(text.count("="), text.count(":"))


def _more(kind: str) -> str:
    return f"holds more than {MOST_VALUES:,} keys and values; is it a {kind}? Give courses over time as CSV files"


def _too_much(path: Path, message: str) -> InputError:
    return InputError([Issue(f"the file {message}", file=str(path))])


def _check_digits(path: Path, text: str) -> None:
    half = _MANY_DIGITS // 2  # a run that long holds a whole block of half its length
    for start in range(0, len(text), half):
        if text[start : start + half].isdecimal() and start + half <= len(text):
            raise _endless(path, text, start)


def _endless(path: Path, text: str, offset: int) -> InputError:
    return InputError([_at_offset(path, text, Issue("a number with too many digits"), offset)])


def _check_toml(path: Path, text: str, kind: str) -> None:
    if len(text) > LARGEST_TOML:
        raise _too_much(path, f"is longer than {LARGEST_TOML:,} characters; is it a {kind}?")
    if _amount(text) > MOST_VALUES:
        raise _too_much(path, _more(kind))
    check_keys(text)


def _at_offset(path: Path, text: str, issue: Issue, offset: int) -> Issue:
    start = text.rfind("\n", 0, offset) + 1
    end = text.find("\n", offset)
    source = text[start : end if end >= 0 else len(text)]
    line = text.count("\n", 0, offset) + 1
    return replace(issue, file=str(path), line=line, column=offset - start + 1, source=source)


def _loads_toml(path: Path, text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        message = str(error)
        head, mark, tail = message.rpartition("(at ")
        place = _TOML_PLACE.match(mark + tail)
        reason = head.rstrip() if place else message
        lines = text.rstrip("\n").split("\n")
        line, column = len(lines), len(lines[-1]) + 1
        if place and place[1]:
            line, column = int(place[1]), int(place[2])
        if _REPEATED.search(reason):  # of what follows it, nothing is known, not even that it is TOML
            before = "\n".join([*lines[: line - 1], lines[line - 1][: column + _LONG_HEADER]])
            repeated = duplicates(path, lines, positions(before, ".toml"), 1)
            if repeated:
                raise InputError(repeated) from None
        reason = reason if len(reason) <= 200 else f"{reason[:197]}..."
        issue = Issue(f"not valid TOML: {reason[:1].lower()}{reason[1:]}")
        raise InputError([at(path, lines, issue, line, column)]) from None


def _loads_json(path: Path, text: str) -> tuple[dict[str, Any], str]:
    repeated: list[str] = []

    def table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        result = dict(pairs)
        if len(result) < len(pairs) and not repeated:
            repeated.append(Counter(key for key, _ in pairs).most_common(1)[0][0])
        return result

    try:
        data = json.loads(text, object_pairs_hook=table)
    except json.JSONDecodeError as error:
        issue = Issue(f"not valid JSON: {error.msg[:1].lower()}{error.msg[1:]}")
        raise InputError([_at_offset(path, text, issue, error.pos)]) from None
    if not isinstance(data, dict):
        issue = Issue("expected a JSON object { ... } at the top of the file")
        raise InputError([_at_offset(path, text, issue, 0)])
    return data, repeated[0] if repeated else ""
