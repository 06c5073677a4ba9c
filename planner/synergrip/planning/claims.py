"""What a file claims of its references, compared with what they do: number by number.

A number is right when it differs from ours by no more than 1e-6 of itself, and by what rounding leaves of the terms
that it is made of (`EXACT`): another processor rounds another way. What follows from the references is compared; that
none are better does not, and is not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.planning.between import LIMIT
from synergrip.planning.outcome import Check
from synergrip.planning.sizes import EXACT, Sizes

CLAIMED = "claimed "
AS_WRITTEN = "numbers as written"
"""The check of a file's own digest."""


@dataclass(frozen=True)
class Difference:
    """A claim that is not what the references do."""

    key: str
    says: object
    found: object
    error: float
    """Against the tolerance `LIMIT`; infinity for words, and for numbers that are not there."""


@dataclass(frozen=True)
class Claims:
    """The claims of a file."""

    checks: tuple[Check, ...] = ()
    """One for each key of the file that was compared."""
    differences: tuple[Difference, ...] = ()
    """The worst of each key that is not right."""
    skipped: tuple[str, ...] = ()
    """Keys that were not compared: they do not follow from the references, or nothing is known of them."""
    right: tuple[str, ...] = ()
    """The keys that are as they should be."""


def compared(
    claimed: Mapping[str, Any], expected: Mapping[str, Any], sizes: Sizes, unchanged: bool | None = None
) -> Claims:
    """Return what becomes of the claims of a file.

    Args:
        claimed: what the file holds.
        expected: what its references do, with the same keys.
        sizes: of the terms that the numbers are made of.
        unchanged: whether the numbers are those that were written, by a digest in the file; None when there is none.
    """
    checks, differences, right = [], [], []
    for key in claimed:
        if key not in expected:
            continue
        found = list(_differences(key, claimed[key], expected[key], sizes.of(key)))
        worst = max(found, key=lambda each: each.error, default=None)
        checks.append(Check(CLAIMED + key, 0.0 if worst is None else worst.error, LIMIT))
        if checks[-1].passed:
            right.append(key)
        elif worst is not None:
            differences.append(worst)
    if unchanged is not None:
        checks.append(Check(AS_WRITTEN, float(not unchanged), 0.0))
        right += [AS_WRITTEN] * unchanged
    return Claims(tuple(checks), tuple(differences), tuple(key for key in claimed if key not in expected), tuple(right))


def _differences(key: str, says: Any, found: Any, size: Any) -> Iterator[Difference]:
    """Yield every difference, also those that are rounding; nested values by their own keys."""
    if isinstance(found, Mapping):
        yield from _of_table(key, says, found, size)
    elif isinstance(found, list | tuple):
        yield from _of_list(key, says, found, size)
    elif isinstance(found, np.ndarray):
        yield from _of_array(key, says, found, size)
    elif _is_number(says) and _is_number(found):
        yield Difference(key, says, found, float(_error(np.array(says), np.array(found), np.array(size))))
    elif says != found or isinstance(says, bool) is not isinstance(found, bool):
        yield Difference(key, _short(says), found, np.inf)


def _of_table(key: str, says: Any, found: Mapping[str, Any], size: Any) -> Iterator[Difference]:
    if not isinstance(says, Mapping):
        yield Difference(key, _short(says), "a table", np.inf)
        return
    for name in says:
        if name in found:
            inner = size.get(name, 0.0) if isinstance(size, Mapping) else size
            yield from _differences(f"{key}.{name}", says[name], found[name], inner)


def _of_list(key: str, says: Any, found: Sequence[Any], size: Any) -> Iterator[Difference]:
    if not isinstance(says, list | tuple) or len(says) != len(found):
        yield Difference(key, _short(says), _short(found), np.inf)
        return
    each = size if isinstance(size, list) else [size] * len(found)
    for i, (one, other, inner) in enumerate(zip(says, found, each, strict=True)):
        yield from _differences(f"{key}[{i}]", one, other, inner)


def _of_array(key: str, says: Any, found: Array, size: Any) -> Iterator[Difference]:
    """Yield the worst difference of an array; a row that is not finite is not compared."""
    try:
        like = isinstance(says, list | tuple | np.ndarray) and len(says) == len(found)
        given = np.asarray(says if like else (), dtype=float)
    except (TypeError, ValueError):
        given = np.zeros(0)
    if given.shape != found.shape:
        yield Difference(key, f"{' x '.join(map(str, given.shape))} numbers", f"{found.shape}", np.inf)
        return
    if not given.size:
        return
    errors = _error(given, found, np.broadcast_to(size, found.shape))
    at = np.unravel_index(int(np.argmax(errors)), errors.shape)
    place = "".join(f"[{i}]" for i in at)
    yield Difference(f"{key}{place}", float(given[at]), float(found[at]), float(errors[at]))


def _error(says: Array, found: Array, size: Array) -> Array:
    """Return how far a claim is off, relative to the number and to the terms that it is made of; 0 when it is right."""
    off = np.abs(says - found)
    against = np.abs(found) + EXACT / LIMIT * size
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(off == 0, 0.0, np.nan_to_num(off / against, nan=np.inf, posinf=np.inf))


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _short(value: object) -> object:
    """Return a value in few words."""
    return f"{len(value)} entries" if isinstance(value, list | tuple | Mapping) else value
