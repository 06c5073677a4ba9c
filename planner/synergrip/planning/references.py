"""Synergy references read back: from a plan of ours, or from a CSV of anybody's."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from os.path import exists, isdir  # unlike those of Path, no error for a name that is too long
from pathlib import Path
from types import NoneType
from typing import Any

import numpy as np

from synergrip.archives import NoArchiveError, read_arrays
from synergrip.documents.csv_cells import CellReader
from synergrip.documents.documents import read_document
from synergrip.documents.time_table import REFERENCES, SHOWN, TIME, read_table
from synergrip.errors import InputError, shortened
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.planning.arrays import ARRAYS, columns_of
from synergrip.planning.digest import KEY as DIGEST
from synergrip.planning.digest import digest, unchanged
from synergrip.values import Value

KEY = "PLAN"
PER_KNOT = frozenset(each.key for each in ARRAYS if not each.inside)
"""What plan.json holds for each knot."""
IN_ARCHIVE = (*(each.key for each in ARRAYS), "joints", "synergies", "contacts", DIGEST)
"""What plan.npz holds."""


@dataclass(frozen=True, eq=False, repr=False)
class References(Value):
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


def plan_file(path: Path) -> Path:
    """Return the plan.json of a folder; a file as it is."""
    return path / "plan.json" if isdir(path) else path


def read_references(path: Path, grasp: Grasp) -> References:
    """Return times (T,) and references dz_r (T, n_z) of a plan, with all that it claims of them.

    Args:
        path: plan.json, plan.npz, a CSV, or a folder with a plan.json in it. A CSV has ``t_s``, a column for each
            synergy, in the order ``zr_1,...`` or by name as in plan.csv, and any others.
        grasp: that it is to be judged on.

    Raises:
        InputError: no such file, no plan in it, or another number of synergies.
    """
    path = plan_file(path)
    readers: dict[str, Callable[[Path], References]] = {
        ".json": _from_json, ".npz": _from_npz, ".csv": lambda path: _from_csv(path, columns_of(grasp)["dz_r"])
    }  # fmt: skip
    if path.suffix not in readers:
        raise InputError.at(KEY, f"'{path}' is no plan; expected a folder, or a file .json, .npz or .csv")
    if not exists(path):
        raise InputError.at(KEY, f"there is no file '{path}'")
    table = readers[path.suffix](path)
    count = table.values.shape[1]
    if count != grasp.n_z:
        raise InputError.at(KEY, f"'{path}' has {count} synergy references, the grasp has n_z = {grasp.n_z}")
    return table


def _from_csv(path: Path, columns: Sequence[str]) -> References:
    reader = CellReader.of(path, KEY)
    names = [cell.text for cell in reader.header(reader.rows())]
    given = [name for name in names if name.startswith(REFERENCES)]
    numbered = all(name.removeprefix(REFERENCES).isdecimal() for name in given)  # in the order of the synergies
    by_name = set(given) == set(columns)
    if not (by_name or numbered):
        listed, wanted = (", ".join(map(shortened, some[:SHOWN])) for some in (given, columns))
        message = f"the references of '{path}' are {listed}; the grasp's are {wanted}, or in this order zr_1, zr_2, ..."
        raise InputError.at(KEY, message)
    table = read_table(path, columns if by_name else REFERENCES, KEY, others=True)
    others = [name for name in names if name != TIME and not name.startswith(REFERENCES)]
    beside = read_table(path, others, KEY, others=True).values.T if others else ()
    return References(table.times, table.values, {"columns": dict(zip(others, beside, strict=True))} if others else {})


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
        stored = read_arrays(path, IN_ARCHIVE, "plan", KEY)
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
