"""A grasp given as matrices (grasp.json): contacts, G, J, S and the compliances, read and judged as a whole."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import Field, create_model

from synergrip.documents.documents import Document, parse, read_document
from synergrip.documents.fields import NUMBER, Name, Number, Positive, Table, Vector, Version, Written, array_of
from synergrip.documents.judging import Arguments, described
from synergrip.documents.naming import naming_arguments
from synergrip.documents.validation import shown
from synergrip.errors import InputError, Issue, one_of, repeated
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.kinds import KINDS, PARAMETERS, described_parameter
from synergrip.grasps.matrix_reading import Count, MatrixReader, unbalanced
from synergrip.linalg import Array, frozen
from synergrip.values import ByContent

MOST_CONTACTS = 250
UNIT = 1e-6  # how far the length of a normal may be from 1


@naming_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class GivenContact(ByContent):
    """One contact of a grasp given as matrices; place and normal are in G, too, and may be left out.

    Args:
        name: of the contact.
        kind: such as ``SoftFinger(friction=0.8, spin_friction=0.01)``.
        point: (3,) position, if known [m].
        normal: (3,) unit vector toward the object, if known.

    Raises:
        InputError: a value that is none.

    Example:
        >>> GivenContact(name="left", kind=HardFinger(friction=0.6), point=(-0.02, 0, 0), normal=(1, 0, 0)).friction
        0.6
    """

    name: str
    kind: ContactKind
    point: Array | None = None
    normal: Array | None = None

    def __post_init__(self) -> None:
        """Judge the values."""
        judge = Arguments("GivenContact")
        judge.text("name", self.name, empty=False)
        judge.one("kind", self.kind, ContactKind, "HardFinger(friction=0.6)")
        for name in ("point", "normal"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, judge.array(name, getattr(self, name), (3,)))
        if self.normal is not None and not judge.issues and abs(np.linalg.norm(self.normal) - 1) > UNIT:
            judge.refuse("normal", f"expected a unit vector, got length {np.linalg.norm(self.normal):.9g}")
        judge.finish()

    @property
    def friction(self) -> float:
        """Coulomb coefficient; 0 for a frictionless contact."""
        return self.kind.least_friction


@dataclass(frozen=True, kw_only=True, eq=False)
class Matrices(ByContent):
    """The statics of a grasp, in SI units; contact rows (n, t, o [, moment about n]), normals toward the object."""

    title: str
    contacts: tuple[GivenContact, ...]
    G: Array
    """(6, n_l) grasp matrix."""
    J: Array
    """(n_l, n_q) hand Jacobian."""
    S: Array
    """(n_q, n_z) synergy matrix."""
    C_s: Array
    """(n_l, n_l) contact compliance."""
    C_q: Array
    """(n_q, n_q) joint compliance."""
    C_z: Array
    """(n_z, n_z) synergy compliance."""
    lambda_0: Array | None = None
    """(n_l,) initial contact forces of the hand on the object, if given."""
    w_0: Array | None = None
    """(6,) initial external wrench, if given."""
    expect: Mapping[str, Any] = field(default_factory=dict)
    """The expected answers, as they stand in the file."""


def _kind(value: object) -> str:
    if not isinstance(value, str) or value not in KINDS:
        raise InputError.at(
            "", one_of(value, KINDS) if isinstance(value, str) else f"expected a kind, got {shown(value)}"
        )
    return value


class ContactFileBasics(Table):
    """What a contact of any kind has in the file."""

    name: Name = Field(description="name of the contact")
    kind: Annotated[str, Written(_kind, {"enum": list(KINDS)})] = Field(description=f"kind: {', '.join(KINDS)}")
    point_m: Vector | None = Field(default=None, description="position in metres")
    normal: Vector | None = Field(default=None, description="unit normal toward the object")

    def issues(self) -> Iterable[Issue]:
        """Refuse parameters that the kind of contact cannot have or lacks, and a normal that is no unit vector."""
        parameters = KINDS[self.kind].parameters
        friction = getattr(self, "friction", None)
        if friction is not None and (friction < 0 or (friction == 0 and parameters)):
            hint = "; for no friction use kind 'frictionless'" if parameters else ""
            yield Issue(f"must be greater than 0, got {friction:g}{hint}", key="friction")
        for each in parameters:
            if getattr(self, each.key) is None:
                yield Issue(f"missing key '{each.key}' (a {self.kind} contact needs it)", key=each.key, on_key=True)
        if self.normal is not None and abs(math.hypot(*self.normal) - 1) > UNIT:
            yield Issue(f"expected a unit vector, got length {math.hypot(*self.normal):.9g}", key="normal")

    def data(self) -> GivenContact:
        """Return the contact as a value."""
        kind = KINDS[self.kind]
        return GivenContact(
            name=self.name,
            kind=kind.taking({each.name: getattr(self, each.key) for each in kind.parameters}),
            point=None if self.point_m is None else frozen(self.point_m),
            normal=None if self.normal is None else frozen(self.normal),
        )


if TYPE_CHECKING:
    ContactFile = ContactFileBasics
else:  # the parameters are those that the kinds say they have
    ContactFile = create_model(
        "ContactFile",
        __base__=ContactFileBasics,
        __doc__="A contact as it stands in the file.",
        **{
            each.key: (
                (Number if each.name == "friction" else Positive) | None,
                Field(default=None, description=described_parameter(each) + (", in metres" if each.length else "")),
            )
            for each in PARAMETERS.values()
        },
    )


Raw = Annotated[Any, Written(lambda value: value, array_of(array_of(NUMBER)))]
RawVector = Annotated[Any, Written(lambda value: value, array_of(NUMBER))]
RawCompliance = Annotated[Any, Written(lambda value: value, {"anyOf": [NUMBER, array_of(array_of(NUMBER))]})]


class GraspFile(Table):
    """The file as it stands; the matrices are judged together, by `read_matrices`."""

    version: Version = Field(alias="schema", description="version of the file format: 1")
    title: str = Field(default="", description="what the grasp is")
    source: str = Field(default="", description="where the numbers come from")
    contacts: Annotated[tuple[ContactFile, ...], Field(min_length=1, max_length=MOST_CONTACTS)] = Field(
        description="the contacts, in the order of the rows of J"
    )
    G: Raw = Field(description="grasp matrix, 6 x n_l")
    J: Raw = Field(description="hand Jacobian, n_l x n_q")
    S: Raw = Field(description="synergy matrix, n_q x n_z")
    C_s: RawCompliance = Field(description="contact compliance, matrix or number")
    C_q: RawCompliance = Field(default=0, description="joint compliance, matrix or number")
    C_z: RawCompliance = Field(default=0, description="synergy compliance, matrix or number")
    lambda_0: RawVector = Field(default=None, description="initial contact forces, n_l numbers")
    w_0: RawVector = Field(default=None, description="initial external wrench, 6 numbers")
    expect: dict[str, Any] = Field(default_factory=dict, description="expected answers")

    def issues(self) -> Iterable[Issue]:
        """Refuse a name that two contacts have."""
        names = [contact.name for contact in self.contacts]
        for index in repeated(names):
            first = names.index(names[index])
            message = f"two contacts have the name '{names[index]}' (first contacts[{first}])"
            yield Issue(message, f"contacts[{index}].name")


@naming_arguments
def read_matrices(path: str | Path, key: str = "") -> Matrices:
    """Read and judge a grasp given as matrices.

    Args:
        path: the JSON file.
        key: the key of the problem file that names it. When it is given, the issue of a file that is not
            there has no place, for the problem's `Document.locate` to fill in.

    Raises:
        InputError: all the issues of the file, each with its place.

    Example:
        >>> read_matrices("grasp.json").G.shape  # doctest: +SKIP
        (6, 9)
    """
    if not isinstance(path, str | Path) or not str(path):
        raise InputError.at("path", f"expected the path of a grasp file, such as 'grasp.json', got {described(path)}")
    document = read_document(Path(path), "grasp file", key, numbers=True)
    issues: list[Issue] = []
    contacts: tuple[ContactFile, ...] | None = None
    try:
        contacts = parse(document, GraspFile).contacts
    except InputError as error:
        issues += error.issues
        if any(issue.key == "schema" for issue in issues):  # another version may mean anything
            raise
    reader = MatrixReader()
    matrices = _read(document, contacts, reader)
    issues += [document.locate(issue) for issue in reader.issues]
    if issues or matrices is None:
        raise InputError(sorted(issues, key=lambda issue: (issue.line, issue.column)))
    return matrices


def _read(document: Document, contacts: tuple[ContactFile, ...] | None, reader: MatrixReader) -> Matrices | None:
    data = document.data
    n_l = None if contacts is None else _rows(contacts)
    given = {key: data[key] for key in ("G", "J", "S") if key in data}  # what is missing has been noted
    G = reader.matrix("G", given["G"], Count(6), n_l) if "G" in given else None
    J = reader.matrix("J", given["J"], n_l, None) if "J" in given else None
    n_q = None if J is None else Count(J.shape[1], "n_q is the number of columns of J")
    S = reader.matrix("S", given["S"], n_q, None) if "S" in given else None
    n_z = None if S is None else Count(S.shape[1], "n_z is the number of columns of S")
    C_s = reader.compliance("C_s", data["C_s"], n_l) if "C_s" in data else None
    C_q = reader.compliance("C_q", data.get("C_q", 0), n_q)
    C_z = reader.compliance("C_z", data.get("C_z", 0), n_z)
    lambda_0 = reader.vector("lambda_0", data["lambda_0"], n_l) if "lambda_0" in data and n_l else None
    w_0 = reader.vector("w_0", data["w_0"], Count(6)) if "w_0" in data else None
    if contacts is None or G is None or J is None or S is None or C_s is None or C_q is None or C_z is None:
        return None
    if lambda_0 is not None and w_0 is not None:
        _judge_balance(G, lambda_0, w_0, reader)
    return Matrices(
        title=data.get("title", ""), contacts=tuple(contact.data() for contact in contacts), G=G, J=J, S=S,
        C_s=C_s, C_q=C_q, C_z=C_z, lambda_0=lambda_0, w_0=w_0, expect=data.get("expect", {}),
    )  # fmt: skip


def _rows(contacts: tuple[ContactFile, ...]) -> Count:
    counts = Counter(contact.kind for contact in contacts)
    number = sum(len(KINDS[kind].components) * count for kind, count in counts.items())
    parts = " and ".join(f"{count} {kind}" for kind, count in counts.items())
    plural = "s" if len(contacts) > 1 else ""
    return Count(number, f"n_l = {number} follows from {parts} contact{plural}")


def _judge_balance(G: Array, lambda_0: Array, w_0: Array, reader: MatrixReader) -> None:
    if message := unbalanced(G, lambda_0, w_0):
        reader.refuse("w_0", message)
