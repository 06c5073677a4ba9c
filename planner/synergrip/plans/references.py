"""Synergy references read back: from a plan of ours, or from a CSV of anybody's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain
from os.path import exists, isdir  # unlike those of Path, no error for a name that is too long
from pathlib import Path
from types import NoneType

import numpy as np

from synergrip.archives import NoArchiveError, read_arrays
from synergrip.documents import read_document
from synergrip.errors import InputError, shortened
from synergrip.linalg import Array, frozen
from synergrip.plans.reading.tables import REFERENCES, read_table

KEY = "PLAN"


STORED = ("lambda", "tau", "du")
"""What a plan of ours also holds, and what a check compares with its own figures."""


@dataclass(frozen=True)
class References:
    """Synergy references at times, and the consequences that the file claims for them."""

    times: Array  # (T,) [s]
    values: Array  # (T, n_z) dz_r
    claimed: Mapping[str, Array]
    """Of `STORED`, what the file holds: (T, ...) each."""


def read_references(path: Path, n_z: int) -> References:
    """Return times (T,) and references dz_r (T, n_z) of a plan, with the forces and motions it claims.

    Args:
        path: plan.json, plan.npz, a CSV with ``t_s,zr_1,...`` (further columns are ignored), or a folder with
            a plan.json in it.
        n_z: number of synergies of the grasp it is to be judged on.

    Raises:
        InputError: no such file, no plan in it, or another number of synergies.
    """
    if isdir(path):
        path = path / "plan.json"
    readers = {".json": _from_json, ".npz": _from_npz, ".csv": _from_csv}
    if path.suffix not in readers:
        raise InputError.at(KEY, f"'{path}' is no plan; expected a folder, or a file .json, .npz or .csv")
    if not exists(path):
        raise InputError.at(KEY, f"there is no file '{path}'")
    table = readers[path.suffix](path)
    if table.values.shape[1] != n_z:
        raise InputError.at(KEY, f"'{path}' has {table.values.shape[1]} synergy references, the grasp has n_z = {n_z}")
    return table


def _from_csv(path: Path) -> References:
    table = read_table(path, REFERENCES, KEY, others=True)
    return References(table.times, table.values, {})


def _from_json(path: Path) -> References:
    data = read_document(path, "plan", KEY, numbers=True).data
    if "dz_r" not in data or "time_s" not in data:
        verdict = data.get("verdict")
        why = f"its verdict is '{shortened(str(verdict))}'" if verdict else "dz_r and time_s are missing"
        raise InputError.at(KEY, f"'{path}' holds no plan: {why}")
    return _references(path, data)


def _from_npz(path: Path) -> References:
    try:
        stored = read_arrays(path, ("dz_r", "time_s", *STORED), "plan", KEY)
    except NoArchiveError as error:
        raise InputError.at(KEY, f"'{path}' is no .npz archive of plain arrays ({error})") from None
    if "dz_r" not in stored or "time_s" not in stored:
        raise InputError.at(KEY, f"'{path}' holds no plan: dz_r and time_s are missing")
    return _references(path, stored)


def _references(path: Path, data: Mapping[str, object]) -> References:
    t, z = _numbers(path, data, "time_s", 1), _numbers(path, data, "dz_r", 2)
    claimed = {name: _numbers(path, data, name, 2) for name in STORED if name in data}
    for name, array in {"dz_r": z, **claimed}.items():
        if len(array) != len(t):
            raise InputError.at(KEY, f"'{path}': {name} has {len(array)} rows for {len(t)} times")
    if not np.all(np.diff(t) > 0):
        raise InputError.at(KEY, f"'{path}': times must increase")
    return References(t, z, claimed)


def _numbers(path: Path, data: Mapping[str, object], name: str, dimensions: int) -> Array:
    """Return an array of finite numbers, with at least one row."""
    try:
        if not _is_plain(data[name]):
            raise TypeError
        array = np.asarray(data[name], dtype=float)
    except (TypeError, ValueError):
        raise InputError.at(KEY, f"'{path}': {name} is no array of numbers") from None
    if array.ndim != dimensions or not len(array) or not np.all(np.isfinite(array)):
        expected = "(T) numbers" if dimensions == 1 else "(T x n) numbers"
        raise InputError.at(KEY, f"'{path}': expected {name} as {expected}, all finite; got shape {array.shape}")
    return frozen(array)


def _is_plain(value: object) -> bool:
    """Tell of a list, quickly, whether it holds numbers alone, or rows of numbers of one length; True of the rest."""
    if not isinstance(value, list) or not value:
        return True
    kinds = set(map(type, value))
    if kinds == {list} and len(set(map(len, value))) == 1:
        kinds = set(map(type, chain.from_iterable(value)))
    return kinds <= {int, float, NoneType}  # a null becomes a number that is not finite
