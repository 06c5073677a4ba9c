"""Limits between the knots, written down a second time: at the corners, and with the reserve that curves need."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from synergrip.conic.goals.goal import Goal
from synergrip.conic.intersample import Intersample, Looks
from synergrip.conic.limits.limit import Limit
from synergrip.conic.question import Question
from synergrip.linalg import Array, interpolated
from synergrip.referee.beside_knots import beside
from synergrip.referee.formulas import write_goal, write_limit
from synergrip.referee.model import Cone, Expression, Model, Written

Writer = Callable[[Looks, Expression | None], Model]
"""Writes a task down at any instants, with given references or any."""


@dataclass(frozen=True)
class Instants:
    """The same task written down between the knots: at the corners, and in curved pieces along chords and as it is."""

    intersample: Intersample
    corners: Model | None
    """Its references are those of the knots, on straight lines between them; None when there are no corners."""
    straight: Model | None
    """None when nothing is curved."""
    bent: Model | None

    @classmethod
    def of(cls, model: Model, intersample: Intersample, write: Writer) -> Instants:
        """Write the task of `model` down with `write`: at other instants, with given references or any."""
        corners = intersample.corners

        def at(looks: Looks, references: Expression | None) -> Model:
            return beside(model, looks) if model.maps.each else write(looks, references)

        inside = at(corners, _shares(corners.times, model.times) @ model.dz_r) if len(corners.times) else None
        if intersample.exact:
            return cls(intersample, inside, None, None)
        return cls(intersample, inside, at(intersample.chords, None), at(intersample.curved, None))

    def kept(
        self, at: Sequence[Cone], inside: Sequence[Cone], again: Callable[[Model], Sequence[Cone]]
    ) -> tuple[list[Cone], list[Cone]]:
        """Return cones at the knots and at the corners, lower by what curved loads beside them can take away.

        Args:
            at: of a limit or goal, at the knots.
            inside: the same at the corners; empty when there are none.
            again: writes the same limit or goal down for any instants.
        """
        if self.straight is None or self.bent is None:
            return list(at), list(inside)
        pairs = zip(_values(again(self.straight)), _values(again(self.bent)), strict=True)
        needed = [self.intersample.needed(_lost(*pair)) for pair in pairs]
        corner = self.intersample.corner
        return _lower(at, [each[~corner] for each in needed]), _lower(inside, [each[corner] for each in needed])


def _lower(cones: Sequence[Cone], by: Sequence[Array]) -> list[Cone]:
    return [replace(cone, head=cone.head - each) for cone, each in zip(cones, by, strict=False)]


def _shares(times: Array, knots: Array) -> Array:
    """Return what each knot (T,) has of each instant (C,) on straight lines between the knots."""
    return interpolated(times, knots, np.eye(len(knots)))


@dataclass(frozen=True)
class Inside:
    """What is asked at the corners between the knots."""

    limits: tuple[Cone, ...] = ()
    objective: tuple[Cone, ...] = ()
    same: tuple[Expression, ...] = ()
    """That the goal's scalar is the same there."""


def cones_of(question: Question, model: Model, write: Writer) -> tuple[Written, list[Cone], Inside]:
    """Write goal and limits down at the knots, and between them when that is asked for.

    Args:
        question: limits and goal over a formulation.
        model: the task at the knots.
        write: writes the task down at other instants.
    """
    objective = write_goal(model, question.goal)
    intersample = question.formulation.intersample
    if intersample is None:
        return objective, [cone for limit in question.limits for cone in write_limit(model, limit)], Inside()
    instants = Instants.of(model, intersample, write)
    cones: list[Cone] = []
    inside: list[Cone] = []
    for limit in question.limits:
        at = write_limit(model, limit)
        if limit.couples_knots:
            cones += at
            continue
        there = () if instants.corners is None else write_limit(instants.corners, limit)
        kept, between = instants.kept(at, there, partial(_limit_again, limit))
        cones, inside = cones + kept, inside + between
    other = None if instants.corners is None else write_goal(instants.corners, question.goal)
    again = partial(_objective_again, question.goal)
    kept, between = instants.kept(objective.cones, () if other is None else other.cones, again)
    same = () if other is None or other.scalar is None else (other.scalar == objective.scalar,)
    return replace(objective, cones=tuple(kept)), cones, Inside(tuple(inside), tuple(between), same)


def _objective_again(goal: Goal, there: Model) -> tuple[Cone, ...]:
    return write_goal(there, goal).cones


def _limit_again(limit: Limit, there: Model) -> tuple[Cone, ...]:
    return write_limit(there, limit)


def _values(cones: Sequence[Cone]) -> list[tuple[Array, Array | None]]:
    """Return heads and tails with the references, and every other unknown, at 0."""
    values = []
    for cone in cones:
        for part in (cone.head, cone.tail):
            for variable in getattr(part, "variables", list)():
                variable.value = np.zeros(variable.shape)
        tail = None if cone.tail is None else np.asarray(cone.tail.value)
        values.append((np.asarray(getattr(cone.head, "value", cone.head)), tail))
    return values


def _lost(before: tuple[Array, Array | None], after: tuple[Array, Array | None]) -> Array:
    """Return what the head loses and the rest gains at every instant, in the shape of the head."""
    need = np.maximum(before[0] - after[0], 0.0)
    if before[1] is not None and after[1] is not None:
        need = need + np.linalg.norm(after[1] - before[1], axis=1)
    return need
