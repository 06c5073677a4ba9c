"""From a TOML or JSON file to plain values, and from a dotted key back to its place in the file."""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from synergrip.errors import InputError, Issue, suggest
from synergrip.overrides import Override, apply_overrides
from synergrip.positions import KeyPath, Place, Positions, dotted, enclosing, positions
from synergrip.validation import translate

Model = TypeVar("Model", bound=BaseModel)

LARGEST_FILE = 64_000_000  # bytes
LARGEST_NUMBER = 1e100  # products of such numbers stay finite
DEEPEST = 64  # tables and lists inside each other
MOST_ISSUES = 20  # of one sort

_LONG_NUMBER = re.compile(r"[0-9][0-9_]{4299,}")  # more digits than Python converts
_REPEATED = re.compile(r"overwrite|twice|duplicate|mutate", re.IGNORECASE)
_TOML_PLACE = re.compile(r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)\s*\Z")


@dataclass(frozen=True)
class Document:
    """The values of a file, and the text they came from."""

    path: Path
    data: dict[str, Any]
    text: str = ""
    overrides: tuple[Override, ...] = field(default=())

    @cached_property
    def positions(self) -> Positions:
        """Where each key stands."""
        return positions(self.text, self.path.suffix.lower())

    def locate(self, issue: Issue) -> Issue:
        """Return `issue` with file, line, column, length and source line filled in from its key.

        A key that is not in the file is shown at the innermost table or list around it, which may be one that
        an override made. An issue that already names a file is returned as it is.
        """
        if issue.file:
            return issue
        found = self.positions.nearest(issue.key)
        for override in reversed(self.overrides):
            shared = override.shares(issue.key)
            if shared == override.key or len(shared) > len(found[0] if found else ""):
                return replace(issue, file=f"--set {override.text}")
        if found is None:
            return _at(self.path, self.text, issue, 1, 1)
        key, place = found
        on_key = issue.on_key or key != issue.key
        span = place.key if on_key and place.key is not None else place.value
        return _at(self.path, self.text, issue, span.line, span.column, span.length)

    def with_overrides(self, texts: Sequence[str]) -> Document:
        """Return the document with each ``KEY=VALUE`` of `texts` put in; missing tables are created.

        Raises:
            InputError: a text that is no ``KEY=VALUE``, or a key that leads through a number, a string or
                past the end of a list. Every one of them is named.
        """
        if not texts:
            return self
        data, overrides = apply_overrides(self.data, texts)
        document = replace(self, data=data, overrides=self.overrides + overrides)
        _check_values(document)
        return document

    def beside(self, name: str) -> Path:
        """Return the path of `name`, which is written relative to this file."""
        return self.path.parent / name


def read_document(path: Path, kind: str = "file", key: str = "") -> Document:
    """Read a ``.toml`` or ``.json`` file whose top level is a table.

    Args:
        path: the file.
        kind: what it is to the user ("problem file"), for messages.
        key: the key of another file that names this one; see `read_text`.

    Raises:
        InputError: no such file, not UTF-8, a syntax error, a key written twice, a number that is not
            finite; with the place where it stands.
    """
    text = read_text(path, kind, key)
    suffix = path.suffix.lower()
    if suffix not in (".toml", ".json"):
        raise InputError([Issue(f"the name of a {kind} ends in .toml or .json", file=str(path))])
    try:
        data, repeated = _loads_toml(path, text) if suffix == ".toml" else _loads_json(path, text)
        document = Document(path, data, text)
        _check_values(document)
        if repeated:
            raise InputError(_duplicates(path, text, document.positions))
    except RecursionError:
        raise InputError([Issue("tables and lists are nested too deeply", file=str(path))]) from None
    except ValueError:
        raise _too_long(path, text) from None
    return document


def parse(document: Document, model: type[Model]) -> Model:
    """Return the values of `document` as a `model`.

    Raises:
        InputError: all the issues of the file, in file order, each with its place.
    """
    try:
        return model.model_validate(document.data)
    except ValidationError as error:
        found = [document.locate(issue) for issue in translate(error, model)]
    raise InputError(sorted(found, key=lambda issue: (issue.file, issue.line, issue.column)))


def read_text(path: Path, kind: str = "file", key: str = "") -> str:
    """Return the text of a file, without a byte order mark and with plain line feeds.

    Args:
        path: the file.
        kind: what it is to the user, for messages.
        key: the key that names the file; when given, the issue leaves its place to `Document.locate`.

    Raises:
        InputError: missing, a directory, unreadable, too large or not UTF-8.
    """

    def refuse(message: str) -> InputError:
        return InputError([Issue(message, key=key, file="" if key else str(path))])

    try:
        raw = path.read_bytes() if path.stat().st_size <= LARGEST_FILE else None
    except FileNotFoundError:
        raise refuse(f"{kind} '{path}' not found{_similar(path)}") from None
    except IsADirectoryError:
        raise refuse(f"'{path}' is a directory; expected a {kind}") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "the name is not a file name"
        raise refuse(f"{kind} '{path}' cannot be read: {reason}") from None
    if raw is None:
        raise refuse(f"'{path}' is larger than {LARGEST_FILE // 1_000_000} MB; is it a {kind}?")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - raw.rfind(b"\n", 0, error.start)
        message = f"byte {column} of this line is not UTF-8; save the {kind} as UTF-8"
        raise InputError([Issue(message, key=key, file=str(path), line=line, column=column)]) from None
    return text.replace("\r\n", "\n")


def _similar(path: Path) -> str:
    try:
        return suggest(path.name, sorted(entry.name for entry in path.parent.iterdir()))
    except OSError:
        return f"; there is no directory '{path.parent}'"


def _at(path: Path, text: str, issue: Issue, line: int, column: int, length: int = 1) -> Issue:
    lines = text.split("\n")
    source = lines[line - 1] if line <= len(lines) else ""
    return replace(issue, file=str(path), line=line, column=column, length=length, source=source)


def _loads_toml(path: Path, text: str) -> tuple[dict[str, Any], bool]:
    try:
        return tomllib.loads(text), False
    except tomllib.TOMLDecodeError as error:
        message = str(error)
        repeated = _duplicates(path, text, positions(text, ".toml")) if _REPEATED.search(message) else []
        if repeated:
            raise InputError(repeated) from None
        place = _TOML_PLACE.search(message)
        reason = message[: place.start()] if place else message
        lines = text.rstrip("\n").split("\n")
        line, column = len(lines), len(lines[-1]) + 1
        if place and place[1]:
            line, column = int(place[1]), int(place[2])
        issue = Issue(f"not valid TOML: {reason[:1].lower()}{reason[1:]}")
        raise InputError([_at(path, text, issue, line, column)]) from None


def _too_long(path: Path, text: str) -> InputError:
    found = _LONG_NUMBER.search(text)
    start = found.start() if found else 0
    line, column = text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start)
    return InputError([_at(path, text, Issue("a number with too many digits"), line, column)])


def _loads_json(path: Path, text: str) -> tuple[dict[str, Any], bool]:
    repeated = False

    def table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        nonlocal repeated
        result = dict(pairs)
        repeated |= len(result) < len(pairs)
        return result

    try:
        data = json.loads(text, object_pairs_hook=table)
    except json.JSONDecodeError as error:
        issue = Issue(f"not valid JSON: {error.msg[:1].lower()}{error.msg[1:]}")
        raise InputError([_at(path, text, issue, error.lineno, error.colno)]) from None
    if not isinstance(data, dict):
        issue = Issue("expected a JSON object { ... } at the top of the file")
        raise InputError([_at(path, text, issue, 1, 1)])
    return data, repeated


def _duplicates(path: Path, text: str, found: Positions) -> list[Issue]:
    def issue(key: str, first: Place, second: Place) -> Issue:
        span = second.key or second.value
        name = key[len(enclosing(key)) :].lstrip(".")
        message = f"key '{name}' is written twice (first in line {(first.key or first.value).line})"
        return _at(path, text, Issue(message, key=key, on_key=True), span.line, span.column, span.length)

    return [issue(*duplicate) for duplicate in found.duplicates[:MOST_ISSUES]]


def _check_values(document: Document) -> None:
    unusable = islice(_unusable(document.data, ()), MOST_ISSUES)
    issues = [Issue(message, key=dotted(path)) for path, message in unusable]
    if issues:
        raise InputError([document.locate(issue) for issue in issues])


def _unusable(value: object, path: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    if isinstance(value, float) and not math.isfinite(value):
        yield path, f"{value} is not a finite number"
    elif isinstance(value, int | float) and abs(value) > LARGEST_NUMBER:
        yield path, "the number is too large"
    elif isinstance(value, dict | list):
        if len(path) >= DEEPEST:
            raise RecursionError
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, item in items:
            yield from _unusable(item, (*path, key))
