"""The synergy sets of a hand: from the tables of hand.toml and its couplings to S (9)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from synergrip.errors import InputError, Issue, one_of, raise_issues
from synergrip.hands.hand import Coupling, SynergySet
from synergrip.hands.hand_file import HandFile, SynergyTable
from synergrip.hands.synergies.matrix import ALL, JOINTS, coupling_map, joint_set, joint_vector
from synergrip.hands.synergies.synergy_file import read_synergies
from synergrip.hands.units import misfits, synergy_kinds
from synergrip.linalg import frozen

Given = TypeVar("Given")
Value = TypeVar("Value")


def each_of(prefix: str, tables: Mapping[str, Given], make: Callable[[str, Given], Value]) -> dict[str, Value]:
    """Return what `make` makes of each table, or raise the issues of all of them with their keys."""
    made, issues = dict[str, Value](), list[Issue]()
    for name, table in tables.items():
        try:
            made[name] = make(name, table)
        except InputError as error:
            issues += error.under(f"{prefix}.{name}" if prefix else name).issues
    raise_issues(issues)
    return made


def synergy_sets(
    file: HandFile, folder: Path, kinds: Mapping[str, str], couplings: Mapping[str, Coupling]
) -> dict[str, SynergySet]:
    """Return the sets of a hand file in its order, and the set of all joints.

    Args:
        file: the hand file.
        folder: its folder, which paths are relative to.
        kinds: "hinge" or "slide" by joint, in the order of q.
        couplings: what followers follow.

    Raises:
        InputError: couplings or columns that name no joint, a synergy file that does not fit, units of the wrong kind.
    """
    names = tuple(kinds)
    try:
        coupling_map(names, couplings)
    except InputError as error:
        raise error.under("couplings") from None
    made = each_of("synergies", file.synergies, lambda name, table: _set(name, table, folder, kinds, couplings))
    return {**made, JOINTS: joint_set(names)}


def _set(
    name: str, table: SynergyTable, folder: Path, kinds: Mapping[str, str], couplings: Mapping[str, Coupling]
) -> SynergySet:
    if name in (JOINTS, ALL):
        raise InputError.at(
            "", f"'{name}' is the set of all joints, which every hand has; choose another name", on_key=True
        )
    if table.file is not None:
        made = read_synergies(folder / table.file, tuple(kinds), couplings, name=name, key="file")
    else:
        made = _columns(name, table, tuple(kinds), couplings)
    for each in table.effort_limits:
        if each not in made.synergies:
            raise InputError.at(f"effort_limits.{each}", one_of(each, made.synergies), on_key=True)
    efforts = [(f"effort_limits.{each}", each, limit) for each, limit in table.effort_limits.items()]
    offsets = [(f"offset.{joint}", joint, value) for joint, value in table.offset.items()]
    raise_issues([*misfits(offsets, kinds), *misfits(efforts, synergy_kinds(made, kinds.values()), "synergy")])
    limits = frozen([table.effort_limits.get(each, math.inf) for each in made.synergies])
    return replace(made, title=table.title or made.title, effort_limits=limits)


def _columns(name: str, table: SynergyTable, names: Sequence[str], couplings: Mapping[str, Coupling]) -> SynergySet:
    E, e = coupling_map(names, couplings)
    columns = each_of("columns", table.columns or {}, lambda _, weights: joint_vector(names, weights, couplings))
    offset = each_of("", {"offset": table.offset}, lambda _, values: joint_vector(names, values, couplings))["offset"]
    S = E @ np.column_stack(list(columns.values()))
    limits = frozen(np.full(len(columns), math.inf))
    return SynergySet(
        name=name, title=table.title, synergies=tuple(columns), S=S, offset=frozen(E @ offset + e), effort_limits=limits
    )
