"""Synergy references read back: from a plan of ours, or from a CSV of anybody's."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np

from synergrip.documents import read_document
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.plans.reading.tables import REFERENCES, Table, read_table

KEY = "PLAN"


def read_references(path: Path, n_z: int) -> Table:
    """Return times (T,) and references dz_r (T, n_z) of a plan.

    Args:
        path: plan.json, plan.npz, a CSV with ``t_s,zr_1,...`` (further columns are ignored), or a folder with
            a plan.json in it.
        n_z: number of synergies of the grasp it is to be judged on.

    Raises:
        InputError: no such file, no plan in it, or another number of synergies.
    """
    if path.is_dir():
        path = path / "plan.json"
    readers = {".json": _from_json, ".npz": _from_npz, ".csv": _from_csv}
    if path.suffix not in readers:
        raise InputError.at(KEY, f"'{path}' is no plan; expected a folder, or a file .json, .npz or .csv")
    if not path.is_file():
        raise InputError.at(KEY, f"there is no file '{path}'")
    table = readers[path.suffix](path)
    if table.values.shape[1] != n_z:
        raise InputError.at(KEY, f"'{path}' has {table.values.shape[1]} synergy references, the grasp has n_z = {n_z}")
    return table


def _from_csv(path: Path) -> Table:
    return read_table(path, REFERENCES, KEY, others=True)


def _from_json(path: Path) -> Table:
    data = read_document(path, "plan", KEY).data
    if "dz_r" not in data or "time_s" not in data:
        verdict = data.get("verdict")
        why = f"its verdict is '{verdict}'" if verdict else "dz_r and time_s are missing"
        raise InputError.at(KEY, f"'{path}' holds no plan: {why}")
    return _table(path, data["time_s"], data["dz_r"])


def _from_npz(path: Path) -> Table:
    try:
        with np.load(path, allow_pickle=False) as stored:
            if "dz_r" not in stored or "time_s" not in stored:
                raise InputError.at(KEY, f"'{path}' holds no plan: dz_r and time_s are missing")
            return _table(path, stored["time_s"], stored["dz_r"])
    except (ValueError, EOFError, OSError, zipfile.BadZipFile) as error:
        raise InputError.at(KEY, f"'{path}' is no .npz archive of plain arrays ({error})") from None


def _table(path: Path, times: object, values: object) -> Table:
    try:
        t, z = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError.at(KEY, f"'{path}': time_s or dz_r are no arrays of numbers") from None
    if t.ndim != 1 or z.ndim != 2 or len(t) != len(z) or not len(t):
        message = f"'{path}': expected time_s (T) and dz_r (T x n_z), got shapes {t.shape} and {z.shape}"
        raise InputError.at(KEY, message)
    if not _increasing(t) or not np.all(np.isfinite(z)):
        raise InputError.at(KEY, f"'{path}': times must increase and all numbers be finite")
    return Table(frozen(t), frozen(z))


def _increasing(times: Array) -> bool:
    return bool(np.all(np.isfinite(times)) and np.all(np.diff(times) > 0))
