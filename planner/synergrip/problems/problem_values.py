"""A problem as a dict: the values of a problem file that somebody made in code."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.documents.documents import DEEPEST, TOO_DEEP, Document, judged
from synergrip.documents.validation import shown
from synergrip.errors import InputError


def document_of(values: Mapping[str, Any]) -> Document:
    """Return a dict of the structure of a problem file as a document of the current folder, without a text.

    Tuples and arrays stand for lists, NumPy's numbers for numbers, paths for texts.

    Raises:
        InputError: keys that are no texts, values that no file could hold; each with its key.
    """
    return judged(Document(Path(), {key: _plain(value, key, 1) for key, value in _items(values, "")}))


def _plain(value: Any, key: str, depth: int) -> Any:
    """Return a value as it would come out of a file."""
    if depth > DEEPEST:
        raise InputError.at("", TOO_DEEP)
    if isinstance(value, Mapping):
        return {name: _plain(each, f"{key}.{name}", depth + 1) for name, each in _items(value, key)}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(each, f"{key}[{index}]", depth + 1) for index, each in enumerate(value)]
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, bool | int | float | str):
        return value
    raise InputError.at(key, f"expected a text, a number, a list or a table as in a problem file, got {shown(value)}")


def _items(table: Mapping[Any, Any], key: str) -> list[tuple[str, Any]]:
    wrong = [name for name in table if not isinstance(name, str)]
    if wrong:
        raise InputError.at(key or "PROBLEM", f"expected keys that are texts, got {shown(wrong[0])}")
    return list(table.items())
