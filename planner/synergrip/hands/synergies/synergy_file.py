"""A synergy set in a file of its own: the matrix S with the names of its rows and columns."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
from pydantic import Field

from synergrip.documents.documents import Document, parse, read_document
from synergrip.documents.fields import Name, Number, Table, Version
from synergrip.errors import InputError, Issue, OutputError, one_of, raise_issues, repeated
from synergrip.files import IMPOSSIBLE, atomic_path
from synergrip.hands.hand import Coupling, SynergySet
from synergrip.hands.synergies.matrix import coupling_map, drivers
from synergrip.linalg import Array, frozen

SUFFIX = ".toml"
"""What the name of a synergy file ends in."""
MOST = 1000
"""Joints, or synergies."""
AGREEMENT = 1e-6
"""How far the row of a follower may be from what its coupling says, relative to the largest entry of S."""


class SynergyFile(Table):
    """A whole synergy file. Values are SI: rad, or m for a sliding joint, for a synergy at 1."""

    version: Version = Field(alias="schema", description="1")
    title: str = Field(default="", description="what it is, for people")
    joints: tuple[Name, ...] = Field(min_length=1, max_length=MOST, description="names of the joints, one for each row")
    synergies: tuple[Name, ...] = Field(
        min_length=1, max_length=MOST, description="names of the synergies, one for each column"
    )
    S: tuple[tuple[Number, ...], ...] = Field(description="synergy matrix, a row for each joint")
    offset: tuple[Number, ...] | None = Field(default=None, description="joint values at z = 0; 0 when absent")
    explained_variance: tuple[Number, ...] | None = Field(
        default=None, description="share of the variance of the recorded postures that each synergy explains"
    )
    standard_deviation: tuple[Number, ...] | None = Field(
        default=None, description="of the recorded postures along each synergy: how far it is used"
    )

    def issues(self) -> Iterable[Issue]:
        """Refuse names that stand twice and lists that do not fit each other."""
        for key in ("joints", "synergies"):
            names = getattr(self, key)
            for index in repeated(names):
                yield Issue(f"'{names[index]}' is listed twice", key=f"{key}[{index}]")
        if len(self.S) != len(self.joints):
            yield Issue(f"{len(self.S)} rows for {len(self.joints)} joints", key="S")
        for index, row in enumerate(self.S):
            if len(row) != len(self.synergies):
                yield Issue(f"{len(row)} numbers for {len(self.synergies)} synergies", key=f"S[{index}]")
        for key, count, of in (
            ("offset", len(self.joints), "joints"),
            ("explained_variance", len(self.synergies), "synergies"),
            ("standard_deviation", len(self.synergies), "synergies"),
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
    document, file = _parsed(path, key)
    try:
        S, offset = _matrix(file, joints, couplings)
    except InputError as error:
        raise error.located(document.locate) from None
    limits = frozen(np.full(len(file.synergies), math.inf))
    return SynergySet(
        name=name or path.stem, title=file.title, synergies=file.synergies, S=S, offset=offset, effort_limits=limits
    )


def read_synergy_file(path: Path, key: str = "") -> SynergyFile:
    """Return a synergy file as it stands, whatever hand it is for.

    Raises:
        InputError: as `read_synergies`, as far as the hand has no part in it.
    """
    return _parsed(path, key)[1]


def write_synergy_file(path: Path, file: SynergyFile, key: str = "") -> None:
    """Write a synergy file, whole or not at all; read again it is the same to the last digit.

    Args:
        path: where; its name ends in ``.toml``. What stands there is replaced only when it is a synergy file.
        file: the synergies.
        key: what names the path, for the error.

    Raises:
        InputError: another name, something else stands there, or no file can have that name.
        OutputError: it cannot be written.
    """
    if path.suffix != SUFFIX:
        raise InputError.at(key, f"the name of a synergy file ends in {SUFFIX}, got '{path}'")
    try:
        if path.exists():
            read_synergy_file(path)
        with atomic_path(path) as temporary:
            temporary.write_text(synergy_text(file), encoding="utf-8")
    except InputError as error:
        message = f"'{path}' is there and is no synergy file ({error.issues[0].message}); choose another name"
        raise InputError.at(key, message) from None
    except OSError as error:
        message = f"cannot write '{path}': {error.strerror or error}"
        if error.errno in IMPOSSIBLE:
            raise InputError.at(key, message) from None
        raise OutputError(message, key) from None


def synergy_text(file: SynergyFile) -> str:
    """Return the text of a synergy file, every number with all its digits."""
    lists = {"offset": file.offset, "explained_variance": file.explained_variance,
             "standard_deviation": file.standard_deviation}  # fmt: skip
    rows = [f"    {_numbers(row)},  # {name}" for name, row in zip(file.joints, file.S, strict=True)]
    lines = [f"schema = {file.version}", *([f"title = {_quoted(file.title)}"] if file.title else [])]
    lines += [f"{key} = [{', '.join(map(_quoted, getattr(file, key)))}]" for key in ("joints", "synergies")]
    lines += ["S = [", *rows, "]", *(f"{key} = {_numbers(values)}" for key, values in lists.items() if values)]
    return "\n".join([*lines, ""])


def _numbers(values: Sequence[float]) -> str:
    return f"[{', '.join(repr(value) for value in values)}]"


def _quoted(text: str) -> str:
    """Return a TOML string; what cannot be UTF-8, such as a strange file name, becomes ``?``."""
    return json.dumps(text.encode("utf-8", "replace").decode(), ensure_ascii=False).replace("\x7f", "\\u007f")


def _parsed(path: Path, key: str) -> tuple[Document, SynergyFile]:
    document = read_document(path, "synergy file", key)
    return document, parse(document, SynergyFile)


def _matrix(file: SynergyFile, joints: Sequence[str], couplings: Mapping[str, Coupling]) -> tuple[Array, Array]:
    issues = [
        Issue(one_of(name, joints), key=f"joints[{i}]") for i, name in enumerate(file.joints) if name not in joints
    ]
    raise_issues(issues)
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
    raise_issues(issues)
    return frozen(whole[:, :-1]), frozen(whole[:, -1])
