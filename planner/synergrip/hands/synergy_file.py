"""A synergy set in a file of its own: the matrix S with the names of its rows and columns."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from synergrip.documents import parse, read_document
from synergrip.errors import InputError, Issue, one_of
from synergrip.fields import NUMBER, Name, Number, Table, Version, Written, array_of, listed, number
from synergrip.hands.hand import Coupling, SynergySet
from synergrip.hands.synergies import coupling_map, drivers
from synergrip.linalg import Array, frozen

AGREEMENT = 1e-6
"""How far the row of a follower may be from what its coupling says, relative to the largest entry of S."""

Matrix = Annotated[
    tuple[tuple[float, ...], ...],
    Written(lambda value: listed(lambda row: listed(number, row), value, of="rows"), array_of(array_of(NUMBER))),
]


class SynergyFile(Table):
    """A whole synergy file. Values are SI: rad, or m for a sliding joint, for a synergy at 1."""

    version: Version = Field(alias="schema", description="1")
    title: str = Field(default="", description="what it is, for people")
    joints: tuple[Name, ...] = Field(min_length=1, description="names of the joints, one for each row")
    synergies: tuple[Name, ...] = Field(min_length=1, description="names of the synergies, one for each column")
    S: Matrix = Field(description="synergy matrix, a row for each joint")
    offset: tuple[Number, ...] | None = Field(default=None, description="joint values at z = 0; 0 when absent")
    explained_variance: tuple[Number, ...] | None = Field(
        default=None, description="share of the variance of the recorded postures that each synergy explains"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse names that stand twice and lists that do not fit each other."""
        for key in ("joints", "synergies"):
            names = getattr(self, key)
            for index, name in enumerate(names):
                if name in names[:index]:
                    yield Issue(f"'{name}' is listed twice", key=f"{key}[{index}]")
        if len(self.S) != len(self.joints):
            yield Issue(f"{len(self.S)} rows for {len(self.joints)} joints", key="S")
        for index, row in enumerate(self.S):
            if len(row) != len(self.synergies):
                yield Issue(f"{len(row)} numbers for {len(self.synergies)} synergies", key=f"S[{index}]")
        for key, count, of in (
            ("offset", len(self.joints), "joints"),
            ("explained_variance", len(self.synergies), "synergies"),
        ):
            values = getattr(self, key)
            if values is not None and len(values) != count:
                yield Issue(f"{len(values)} numbers for {count} {of}", key=key)


def read_synergies(
    path: Path, joints: Sequence[str], couplings: Mapping[str, Coupling], *, name: str = "", key: str = ""
) -> SynergySet:
    """Return the synergy set that the file at `path` gives to a hand.

    Args:
        path: a TOML file, see `SynergyFile`.
        joints: the joints of the hand, in the order of q; joints that the file leaves out do not move.
        couplings: what its followers follow. The file may leave them out; the rows it has must agree.
        name: of the set; the name of the file when empty.
        key: the key of another file that names this one, for a file that is missing.

    Raises:
        InputError: no such file, numbers that do not fit, a joint that the hand does not have, a row against a
            coupling; with file, line and key.
    """
    document = read_document(path, "synergy file", key)
    file = parse(document, SynergyFile)
    try:
        S, offset = _matrix(file, joints, couplings)
    except InputError as error:
        raise error.located(document.locate) from None
    limits = frozen(np.full(len(file.synergies), math.inf))
    return SynergySet(name or path.stem, file.title, file.synergies, S, offset, limits)


def _matrix(file: SynergyFile, joints: Sequence[str], couplings: Mapping[str, Coupling]) -> tuple[Array, Array]:
    issues = [
        Issue(one_of(name, joints), key=f"joints[{i}]") for i, name in enumerate(file.joints) if name not in joints
    ]
    if issues:
        raise InputError(issues)
    given = np.column_stack([np.array(file.S), file.offset if file.offset is not None else np.zeros(len(file.S))])
    values = np.zeros((len(joints), given.shape[1]))
    values[[list(joints).index(name) for name in file.joints]] = given
    E, e = coupling_map(joints, couplings)
    whole = E @ values
    whole[:, -1] += e
    for name in couplings:
        row = list(joints).index(name)
        if name in file.joints and np.abs(whole[row] - values[row]).max() > AGREEMENT * np.abs(values).max():
            message = f"the row of '{name}' is not what its coupling to {drivers(couplings[name])} says; leave it out"
            issues.append(Issue(message, key=f"joints[{file.joints.index(name)}]"))
    if issues:
        raise InputError(issues)
    return frozen(whole[:, :-1]), frozen(whole[:, -1])
