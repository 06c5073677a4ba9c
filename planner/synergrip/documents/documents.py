"""From a TOML or JSON file to plain values, and from a dotted key back to its place in the file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain, islice
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from synergrip.documents.overrides import Override, apply_overrides
from synergrip.documents.positions import KeyPath, Positions, dotted, positions
from synergrip.documents.syntax import at, duplicates, is_placed, loads, too_long
from synergrip.documents.validation import LARGEST_NUMBER as LARGEST_NUMBER
from synergrip.documents.validation import translate
from synergrip.errors import MOST_ISSUES, InputError, Issue
from synergrip.plain_file import read_text

Model = TypeVar("Model", bound=BaseModel)

DEEPEST = 64  # tables and lists inside each other
TOO_DEEP = f"tables and lists are nested too deeply; at most {DEEPEST} of them may stand inside each other"


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

    @property
    def in_a_file(self) -> bool:
        """False for values that somebody made in code: they are told by key alone."""
        return self.path != Path()

    @cached_property
    def placed(self) -> bool:
        """Whether places are told by line, and not by key alone."""
        return is_placed(self.text)

    @cached_property
    def lines(self) -> list[str]:
        """The lines of the text."""
        return self.text.split("\n")

    def locate(self, issue: Issue) -> Issue:
        """Return `issue` with file, line, column, length and source line filled in from its key.

        A key that is not in the file is shown at the innermost table or list around it, which may be one that
        an override made. An issue that already names a file is returned as it is.
        """
        if issue.file:
            return issue
        found = self.positions.nearest(issue.key) if self.placed and self.in_a_file else None
        for override in reversed(self.overrides):
            shared = override.shares(issue.key)
            if shared == override.key or len(shared) > len(found[0] if found else ""):
                return replace(issue, file=f"--set {override.text}")
        if not self.in_a_file:
            return issue
        if found is None:
            return at(self.path, self.lines, issue, 1, 1) if self.placed else replace(issue, file=str(self.path))
        key, place = found
        on_key = issue.on_key or key != issue.key
        span = place.key if on_key and place.key is not None else place.value
        return at(self.path, self.lines, issue, span.line, span.column, span.length)

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
        try:
            _check_values(document)
        except RecursionError:
            raise InputError([Issue(TOO_DEEP, file="--set")]) from None
        return document

    def beside(self, name: str) -> Path:
        """Return the path of `name`, which is written relative to this file."""
        return self.path.parent / name


def read_document(path: Path, kind: str = "file", key: str = "", *, numbers: bool = False) -> Document:
    """Read a ``.toml`` or ``.json`` file whose top level is a table.

    Args:
        path: the file.
        kind: what it is to the user ("problem file"), for messages.
        key: the key of another file that names this one; see `read_text`.
        numbers: whether a JSON file may be long because a program wrote it; see `syntax`.

    Raises:
        InputError: no such file, not UTF-8, too long, a syntax error, a key written twice, a number that is not
            finite; with the place where it stands.
    """
    text = read_text(path, kind, key)
    suffix = path.suffix.lower()
    if suffix not in (".toml", ".json"):
        raise InputError([Issue(f"the name of a {kind} ends in .toml or .json", file=str(path))])
    try:
        data, repeated = loads(path, text, kind, numbers)
        document = Document(path, data, text)
        _check_values(document)
        if repeated and document.placed:
            raise InputError(duplicates(path, document.lines, document.positions, MOST_ISSUES))
    except RecursionError:
        raise InputError([Issue(TOO_DEEP, file=str(path))]) from None
    except ValueError:
        raise too_long(path, text) from None
    if repeated:
        raise InputError([Issue(f"key '{repeated}' is written twice", key=repeated, file=str(path))])
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


def judged(document: Document) -> Document:
    """Return a document whose values are usable.

    Raises:
        InputError: numbers that are not finite or too large, tables inside each other without end.
    """
    try:
        _check_values(document)
    except RecursionError:
        raise InputError([Issue(TOO_DEEP)]) from None
    return document


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
        if isinstance(value, list) and _are_usable(value):
            return
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, item in items:
            yield from _unusable(item, (*path, key))


def _are_usable(entries: list[object]) -> bool:
    """Tell quickly, for the long lists of matrices and plans, whether there is nothing in them to look into.

    A sum of sizes is not within the largest number when one of them is not, nor when one is no number.
    """
    kinds = set(map(type, entries))
    if kinds == {list}:  # of rows
        entries = list(chain.from_iterable(entries))  # type: ignore[arg-type]
        kinds = set(map(type, entries))
    numbers = entries if kinds <= {int, float} else [entry for entry in entries if type(entry) in (int, float)]
    try:
        return not kinds & {dict, list} and sum(map(abs, numbers)) <= LARGEST_NUMBER  # type: ignore[arg-type]
    except OverflowError:  # a whole number that no float holds
        return False
