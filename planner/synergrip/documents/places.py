"""Places among a number of things, counted from 0 as Python does."""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.documents.judging import described, is_list, is_whole
from synergrip.errors import Issue, UnknownPlaceError


def place_of(key: str, value: Any, count: int) -> int:
    """Return a place among `count`, counted from 0; from the end when it is negative, as Python does.

    Raises:
        UnknownPlaceError: there is no such place.
    """
    if not is_whole(value) or not -count <= value < count:
        there = f"expected a place from 0 to {count - 1}" if count else "there is none"
        raise UnknownPlaceError([Issue(f"{there}, got {described(value)}", key=key)])
    return int(value) % count


def places_of(key: str, value: Any, count: int) -> Any:
    """Return places among `count` as arrays take them: a slice as it is, True or False for each as the places of True.

    Raises:
        UnknownPlaceError: something else, or a place that is not among them.
    """
    if isinstance(value, slice):
        if all(end is None or is_whole(end) for end in (value.start, value.stop, value.step)) and value.step != 0:
            return value
    elif isinstance(value, np.ndarray) and value.ndim == 1:
        if value.dtype.kind == "b" and len(value) == count:
            return np.flatnonzero(value)
        if value.dtype.kind in "iu" and np.all((value >= -count) & (value < count)):
            return value
    elif is_list(value) or isinstance(value, range):
        if len(value) == count and all(isinstance(each, bool | np.bool_) for each in value):
            return np.flatnonzero(value)
        if all(is_whole(each) and -count <= each < count for each in value):
            return np.array(value, dtype=np.intp)
    last = f"from 0 to {count - 1}" if count else "of which there are none"
    wanted = f"expected places {last}: whole numbers, a slice, or True or False for each of {count}"
    raise UnknownPlaceError([Issue(f"{wanted}; got {described(value)}", key=key)])
