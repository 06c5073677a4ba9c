"""Synergy references read back: from a plan of ours, or from a CSV of anybody's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain
from os.path import exists, isdir  # unlike those of Path, no error for a name that is too long
from pathlib import Path
from types import NoneType
from typing import Any

import numpy as np

from synergrip.archives import NoArchiveError, read_arrays
from synergrip.documents.csv_cells import CellReader, cells_of
from synergrip.documents.documents import read_document
from synergrip.documents.time_table import REFERENCES, TIME, read_table
from synergrip.errors import InputError, shortened
from synergrip.linalg import Array, frozen
from synergrip.planning.digest import KEY as DIGEST
from synergrip.planning.digest import digest, unchanged

KEY = "PLAN"
PER_KNOT = (
    "time_s", "alpha", "beta", "gamma", "lambda", "wrench", "du", "dq", "tau", "sigma", "elastic_motion", "sag",
)  # fmt: skip
"""What plan.json holds for each knot."""
WHOLE = ("margin", "joints", "synergies", "contacts")
"""What plan.npz holds besides."""


@dataclass(frozen=True)
class References:
    """Synergy references at times, and what the file claims besides them."""

    times: Array  # (T,) [s]
    values: Array  # (T, n_z) dz_r
    claimed: Mapping[str, Any]
    """By the keys of plan.json, all that the file holds; "columns" are those of a CSV file."""
    unchanged: bool | None = None
    """Whether its numbers are those that were written, by its own digest; None when it has none."""

    def inside(self, chosen: Array) -> dict[str, Any]:
        """Return the claims about some of the times (T,); without those about all of them, when some are left out."""
        if np.all(chosen):
            return dict(self.claimed)
        found: dict[str, Any] = {}
        for key, value in self.claimed.items():
            if key == "columns":
                found[key] = {name: np.asarray(column)[chosen] for name, column in value.items()}
            elif key in PER_KNOT and len(value) == len(chosen):
                found[key] = [each for each, kept in zip(value, chosen, strict=True) if kept]
        return found


def read_references(path: Path, n_z: int) -> References:
    """Return times (T,) and references dz_r (T, n_z) of a plan, with all that it claims of them.

    Args:
        path: plan.json, plan.npz, a CSV with ``t_s,zr_1,...`` and any others, or a folder with a plan.json in it.
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
    reader = CellReader.of(path, KEY)
    number, header = next(reader.rows())
    names = [cell.text for cell in cells_of(header, number)]
    others = [name for name in names if name != TIME and not name.startswith(REFERENCES)]
    columns = read_table(path, others, KEY, others=True).values.T if others else ()
    return References(table.times, table.values, {"columns": dict(zip(others, columns, strict=True))} if others else {})


def _from_json(path: Path) -> References:
    data = read_document(path, "plan", KEY, numbers=True).data
    if "dz_r" not in data or "time_s" not in data:
        raise InputError.at(KEY, f"'{path}' holds no plan: {_no_plan(data)}")
    return references_of(path, data, unchanged(data))


def _no_plan(data: Mapping[str, Any]) -> str:
    """Return why there are no references in a document."""
    verdict = data.get("verdict")
    if not verdict:
        return "dz_r and time_s are missing"
    stage = f" (stage: {shortened(str(data['stage']))})" if data.get("stage") else ""
    why = f": {data['why'][:400]}" if isinstance(data.get("why"), str) else ""
    return (
        f"its verdict is '{shortened(str(verdict))}'{stage}{why}; only references can be checked, and "
        "a no is proven again by `synergrip plan PROBLEM`"
    )


def _from_npz(path: Path) -> References:
    try:
        stored = read_arrays(path, ("dz_r", *PER_KNOT, *WHOLE, DIGEST), "plan", KEY)
    except NoArchiveError as error:
        raise InputError.at(KEY, f"'{path}' is no .npz archive of plain arrays ({error})") from None
    if "dz_r" not in stored or "time_s" not in stored:
        raise InputError.at(KEY, f"'{path}' holds no plan: dz_r and time_s are missing")
    arrays = dict(stored)
    told = str(arrays.pop(DIGEST)) if DIGEST in arrays else None
    same = None if told is None else digest(arrays, sorted(arrays)) == told
    return references_of(path, _named(arrays), same)


def _named(stored: dict[str, Any]) -> dict[str, Any]:
    """Return the arrays of a plan.npz by the keys of plan.json."""
    found = {key: value.tolist() if value.dtype.kind == "U" else value for key, value in stored.items()}
    if "margin" in found:
        found["margin"] = {"per_contact_N": found["margin"]}
    return found


def references_of(path: Path | str, data: Mapping[str, Any], same: bool | None) -> References:
    """Return the references in the values of a plan, and all that it claims of them.

    Args:
        path: where they stand, for messages.
        data: by the keys of plan.json.
        same: whether the numbers are those that were written; None when nothing is known of it.

    Raises:
        InputError: times or references are not such, or do not fit each other.
    """
    t, z = _numbers(path, data, "time_s", 1), _numbers(path, data, "dz_r", 2)
    if len(z) != len(t):
        raise InputError.at(KEY, f"'{path}': dz_r has {len(z)} rows for {len(t)} times")
    if not np.all(np.diff(t) > 0):
        raise InputError.at(KEY, f"'{path}': times must increase")
    return References(t, z, {key: value for key, value in data.items() if key not in ("dz_r", DIGEST)}, same)


def _numbers(path: Path | str, data: Mapping[str, object], name: str, dimensions: int) -> Array:
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
