"""A digest of the numbers of a plan's file: whether any of them, however small, is not the one that was written.

What follows from the references is compared by itself (`plans/claims.py`), to the digits that another processor would
find as well. A digest says nothing about what is right; it sees what lies below these digits, and what cannot be found
again without planning.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

KEY = "digest"
ASIDE = ("provenance",)
"""Keys of a document that are left out: they differ from run to run."""
UNCERTAIN = ("seconds",)
"""Keys at any depth that are left out."""


def with_digest(document: Mapping[str, Any]) -> dict[str, Any]:
    """Return a document with the digest of all that is in it but where it comes from, which no number hangs on.

    One that it had before is replaced.
    """
    keys = sorted(key for key in document if key not in (*ASIDE, KEY))
    return {**document, KEY: {"sha256": digest(document, keys), "of": keys}}


def unchanged(document: Mapping[str, Any]) -> bool | None:
    """Return whether the numbers of a document are those that were written; None when it does not say."""
    stated = document.get(KEY)
    if not isinstance(stated, Mapping) or "sha256" not in stated:
        return None
    keys = stated.get("of")
    if not isinstance(keys, list) or not all(isinstance(key, str) and key in document for key in keys):
        return False
    return bool(digest(document, keys) == stated["sha256"])


def stated_digest(document: Mapping[str, Any]) -> str | None:
    """Return the digest that a document tells of itself, whether it is right or not; None when it tells none."""
    told = document.get(KEY)
    found = told.get("sha256") if isinstance(told, Mapping) else None
    return found if isinstance(found, str) else None


def digest(document: Mapping[str, Any], keys: Sequence[str]) -> str:
    """Return the SHA-256 of the values of some keys, numbers by their 64 bits."""
    found = hashlib.sha256()
    _feed({key: document[key] for key in keys}, found.update)
    return found.hexdigest()


def _feed(value: Any, take: Callable[[bytes], object]) -> None:
    """Hand over the bytes of a value, part by part."""
    if isinstance(value, Mapping):
        for key in sorted(value):
            if key not in UNCERTAIN:
                take(f"{key}:".encode("utf-8", "surrogatepass"))
                _feed(value[key], take)
    elif isinstance(value, np.ndarray) and value.dtype.kind == "f":
        take(f"{value.shape}".encode() + value.astype("<f8").tobytes())
    elif isinstance(value, list | tuple | np.ndarray):
        _feed_list(list(value), take)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        take(np.array(value, dtype="<f8").tobytes())
    else:
        take(f"{value};".encode("utf-8", "surrogatepass"))


def _feed_list(values: list[Any], take: Callable[[bytes], object]) -> None:
    if values and all(isinstance(each, float) for each in values):
        take(np.array(values, dtype="<f8").tobytes())
        return
    for each in values:
        _feed(each, take)
        take(b",")
