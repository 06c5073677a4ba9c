"""What a plan is to hold for beside what its task states: less friction, other loads, contacts that are off.

References are what they are; forces answer to load and contacts by the compliance of grasp and hand. In one grasp they
are affine in both, cones are convex, and so a plan that keeps every limit at the corners of what is allowed keeps it
for all that lies between. Each corner is the same task in the same unknowns, with other numbers (`Case`). Rows with one
matrix in all of them are asked for once, with the least constant, which is as strict; second-order cones are asked for
in each. What contacts that are off add is of either sign: cases of their own where these are few, else a reserve in
every cone, as large as all of them together can take.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING, Protocol

import numpy as np

from synergrip.conic.departure import off_place, together, under_load
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Intersample, Looks
from synergrip.conic.reserve import lost
from synergrip.conic.rows import Kind, Rows
from synergrip.conic.sampled import Sampled
from synergrip.errors import InputError
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.statics import Response
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.equilibrium.setting import Setting

MOST_SAMPLED = 60_000
"""Samples times knots times contacts, at most."""
MOST_CORNERS = 256
"""Cases with contacts off to either side that are looked at together, at most."""


class Scenarios(Protocol):
    """Random samples of a grasp, of which a plan is to hold for a stated share."""

    @property
    def share(self) -> float:
        """Of others that may miss a limit."""

    @property
    def confidence(self) -> float:
        """That no larger share does."""

    @property
    def seed(self) -> int:
        """Of the samples."""

    def count(self, unknowns: int) -> int:
        """Return how many samples a plan of so many numbers takes."""

    def drawn(self, grasp: Grasp, count: int, first: int = 0) -> tuple[Response, ...]:
        """Return the maps of so many samples."""

    @property
    def looks(self) -> int:
        """How often fresh samples on a hand may be looked at."""

    def fresh(self, missing: int = 0) -> int:
        """Return how many fresh samples on a hand are looked at, of which so many may miss a limit."""

    def share_at_most(self, missing: int, count: int) -> float:
        """Return the share that misses, at most, where so many of a number of fresh ones do."""

    def on_hand(self, grasp: Grasp, part: int, number: int) -> Setting:
        """Return a sample of a grasp on a hand."""


class Extra(Protocol):
    """A load beyond the one that a task states."""

    def at(self, times: Array) -> Array:
        """Return it (T, 6) at any times (T,) [s]: forces and moments about B [N, N m]."""


@dataclass(frozen=True, eq=False, repr=False)
class Case(Value):
    """One corner of what is allowed."""

    title: str
    """In words: "mass 0.3 kg, load [1 0 0 0 0 0]"; empty for the load that the task states."""
    extra: Extra | None = None
    force: Array | None = None
    """(T, n_l) what the load adds to the contact forces around a path, where it is known; by the maps there if None."""

    def of(self, formulation: Formulation) -> Formulation:
        """Return a formulation under the load of this case, in the same unknowns."""
        if self.extra is None:
            return formulation
        change = self.extra.at(formulation.times)
        if formulation.along_path:
            known = None if self.force is None else self.force[: formulation.knots]
            return replace(formulation, departure=under_load(formulation.map_of, change, known))
        between = formulation.intersample
        return replace(
            formulation, wrench=frozen(formulation.wrench + change),
            intersample=None if between is None else _loaded(between, self.extra),
        )  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class Allowed(Value):
    """All corners of what is allowed on one grasp."""

    kinds: tuple[ContactKind, ...]
    """(n_c) the contacts with the least friction that is allowed: its cone lies in those of all other values."""
    cases: tuple[Case, ...]
    """The load that the task states is the first."""
    gaps: Array
    """(n_c,) [m] how far each contact may be off along its normal."""
    rounds: int = 0
    """How often what loads add was looked up along a path."""
    scenarios: Scenarios | None = None
    samples: tuple[Response, ...] = ()
    """Of the scenarios, as many as the unknowns of a formulation take; under the load stated."""
    cornered: bool = False
    """Whether contacts that are off are cases of their own, to either side, in place of a reserve that asks for more
    than is needed."""

    @property
    def reserves(self) -> bool:
        """Whether more is asked for than is needed: without an answer nothing is proven."""
        return bool(np.any(self.gaps > 0)) and not self.cornered

    @property
    def asks_more(self) -> bool:
        """Whether a formulation asks for more than what is guaranteed takes: by reserves, or in samples."""
        return self.reserves or bool(self.samples)

    @property
    def exact(self) -> Allowed:
        """What is guaranteed, no more: every corner a case of its own, and no samples."""
        return replace(self, cornered=True, samples=())

    def on(self, formulation: Formulation) -> Allowed:
        """Return it with as many samples as the unknowns of a formulation take."""
        grasp = formulation.response.grasp
        if self.scenarios is None or grasp.held is not None:  # on a hand samples are executed
            return self
        count = self.scenarios.count(formulation.unknowns + 1)
        if count * formulation.knots * grasp.n_c > MOST_SAMPLED:
            message = (
                f"{count} samples at {formulation.knots} knots of {grasp.n_c} contacts are more than are looked at"
            )
            raise InputError.at("Task.allow.scenarios", f"{message}; take fewer knots, or a larger share")
        return replace(self, samples=self.scenarios.drawn(grasp, count))

    @property
    def signs(self) -> tuple[tuple[int, ...], ...]:
        """To which sides the contacts that may be off are: all together, or one after the other where that is much."""
        count = int(np.count_nonzero(self.gaps > 0))
        if self.all_signs:
            return tuple(product((1, -1), repeat=count))
        return tuple(tuple(side * (i == j) for j in range(count)) for i in range(count) for side in (1, -1))

    @property
    def corners(self) -> int:
        """How many cases there are with all contacts that may be off to either side."""
        return len(self.cases) << int(np.count_nonzero(self.gaps > 0))

    @property
    def all_signs(self) -> bool:
        """Whether all sides of all contacts that may be off are few enough to look at them together."""
        return self.corners <= MOST_CORNERS

    def narrowed(self, formulation: Formulation) -> Formulation:
        """Return a formulation with the least friction."""
        response = formulation.response
        pairs = zip(response.grasp.contacts, self.kinds, strict=True)
        contacts = tuple(replace(contact, kind=kind) for contact, kind in pairs)
        return replace(formulation, response=replace(response, grasp=replace(response.grasp, contacts=contacts)))

    def formulations(self, formulation: Formulation) -> tuple[list[Formulation], list[Formulation]]:
        """Return a formulation in all cases, and with one contact after the other off, under the load stated."""
        narrow = self.narrowed(formulation)
        offs = off_place(narrow.map_of, narrow.response.grasp, self.gaps)
        cases = [case.of(narrow) for case in self.cases]
        samples: list[Formulation] = [Sampled.of(narrow, each) for each in self.samples]
        if not self.cornered or not offs:
            return [*cases, *samples], [replace(narrow, departure=off) for off in offs]
        corners = [together(signs, offs) for signs in self.signs]
        cornered = [replace(each, departure=off.beside(each.departure)) for each in cases for off in corners]
        return [*cornered, *samples], []


def in_all_cases(cases: Sequence[Sequence[Rows]], offs: Sequence[Sequence[Rows]]) -> list[Rows]:
    """Return the rows of a limit or goal that hold in all cases, with a reserve for contacts that are off.

    Args:
        cases: the rows in each case, the one of the load stated first.
        offs: the rows with one contact off, for each that may be.
    """
    result = list[Rows]()
    for place, stated in enumerate(cases[0]):
        changes = [each[place].constant - stated.constant for each in offs if stated.kind is not Kind.ZERO]
        result += _reserved(_together([each[place] for each in cases]), changes)
    return result


def _reserved(parts: Sequence[Rows], changes: Sequence[Array]) -> Sequence[Rows]:
    """Return the same rows in several cases with room for what changes of their constants, of either sign, take."""
    if not changes:
        return parts
    first = parts[0]
    if first.over_time is not None:  # the norm over time grows by that of a change at most
        taken = sum(float(np.linalg.norm(change, axis=0).max()) for change in changes)
        return [replace(part, over_time=first.over_time - taken) for part in parts]
    needed = np.zeros_like(first.constant)
    for change in changes:
        needed[:, :: first.dim] += np.maximum(lost(first, change), lost(first, -change))
    return [replace(part, constant=frozen(part.constant - needed)) for part in parts]


def _together(parts: Sequence[Rows]) -> list[Rows]:
    """Return the same rows in several cases as few rows that say as much; of an equation the one of the first case."""
    first = parts[0]
    if first.kind is Kind.ZERO:
        return [first]
    kept: list[Rows] = []
    for part in parts:
        like = next((i for i, each in enumerate(kept) if _says_as_much(each, part)), None)
        if like is None:
            kept.append(part)
        elif part.kind is Kind.NONNEGATIVE:
            kept[like] = replace(kept[like], constant=frozen(np.minimum(kept[like].constant, part.constant)))
    return kept


def _says_as_much(one: Rows, other: Rows) -> bool:
    """Return whether two rows are one: bounds with the same matrix, or cones that are the same."""
    alike = one.matrix is other.matrix or np.array_equal(one.matrix, other.matrix)
    return bool(alike and (one.kind is Kind.NONNEGATIVE or np.array_equal(one.constant, other.constant)))


def _loaded(between: Intersample, extra: Extra) -> Intersample:
    """Return what happens between the knots under a load beyond the one stated."""

    def more(looks: Looks) -> Looks:
        return replace(looks, wrench=frozen(looks.wrench + extra.at(looks.times)))

    return replace(between, grid=more(between.grid), curved=more(between.curved))
