"""How every cone of a plan answers to an extra wrench and to internal forces: one program, and six columns beside it.

The value of all cones is ``b - A x + B w``: x is what is added to the internal forces of all knots, w the extra wrench
in scaled coordinates (`Scale.wrench`), in force units.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.build import build
from synergrip.conic.cones import outside
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.friction_reserve import FrictionReserve
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Kind
from synergrip.grasps.scale import Scale
from synergrip.linalg import Array, Places, frozen
from synergrip.margin.disturbance.reacting import Reacting
from synergrip.planning.outcome import Plan
from synergrip.statics.each import Each
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Cones(Value):
    """The cones of one block: N of them, each with d rows."""

    block: Block
    start: Array
    """(N, d) their values in the plan."""
    change: Array
    """(N, d, 6) what an extra wrench adds."""
    rows: Places
    """(N, d) their places in the program."""

    def place(self, index: int) -> tuple[int, str, str]:
        """Return knot, limit and item of a cone."""
        item = self.block.items[index % len(self.block.items)]
        return int(self.knots[index]), self.block.limit, str(item)

    @property
    def knots(self) -> Places:
        """(N,) the knot of each cone."""
        return self.block.instants

    def at(self, knot: int) -> Cones:
        """Return those of one knot."""
        own = self.knots == knot
        block = replace(self.block, first_knot=knot, knots=int(own.any()))
        return replace(self, block=block, start=self.start[own], change=self.change[own], rows=self.rows[own])

    @property
    def first(self) -> Cones:
        """The same as those of the first knot."""
        return replace(self, block=replace(self.block, first_knot=0))


@dataclass(frozen=True, eq=False, repr=False)
class Reaction(Value):
    """Cones at some instants, and what internal forces and an extra wrench make of them."""

    times: Array
    """(T,) [s]."""
    scale: Scale
    """Says how large a wrench is."""
    unit: float
    """[N] of the scaled wrench."""
    free: Array
    """(6, k) motions of the object that no contact resists: a wrench that works on them is not withstood."""
    under_wrench: Callable[[Array], Program]
    """Returns of an extra wrench (6,) about B [N, N m] the program of the internal forces, whose objective is of no
    use."""
    program: Program
    """Without an extra wrench."""
    columns: Array
    """(m, 6) B."""

    @classmethod
    def made(
        cls, times: Array, scale: Scale, unit: float, free: Array, under_wrench: Callable[[Array], Program]
    ) -> Reaction:
        """Return it with the columns that the programs tell.

        A plan keeps its limits to some digits; where it is beyond one, the limit is taken to be where the plan is.
        """
        known = under_wrench(np.zeros(6))
        room = _room(known)

        def with_room(wrench: Array) -> Program:
            program = under_wrench(wrench)
            return replace(program, b=frozen(program.b + room))

        program = with_room(np.zeros(6))
        moves = [unit * column for column in scale.motion]  # of w = motion' w~
        columns = [under_wrench(wrench).b - known.b for wrench in moves]
        return cls(times, scale, unit, free, with_room, program, frozen(np.column_stack(columns)))

    @classmethod
    def of(cls, plan: Plan, each: Each | None, *, cones_alone: bool = False) -> Reaction:
        """Return that of a plan: of all limits of the task, or of the friction cones alone, without margin or reserve.

        Limits on changes from knot to knot are left out: nothing is said of when the wrench comes.

        Args:
            plan: of any task.
            each: the statics at its knots, `statics_of(plan)`.
            cones_alone: whether the friction cones alone are asked.
        """
        dropped = (FrictionCone, FrictionReserve)
        others = [limit for limit in plan.task.all_limits if not isinstance(limit, dropped) and not limit.couples_knots]
        limits: tuple[Limit, ...] = (FrictionCone(0.0), *(() if cones_alone else others))
        response = plan.analysis.response

        def under_wrench(wrench: Array) -> Program:
            return build(Reacting.of(plan, each, wrench), limits, LeastEffort())

        return cls.made(plan.time, response.scale, plan.formulation.force_unit, response.free, under_wrench)

    @property
    def n_alpha(self) -> int:
        """Internal forces at a knot."""
        return self.program.n_v

    def scaled(self, wrench: Array) -> Array:
        """Return wrenches (..., 6) [N, N m] in scaled coordinates and force units."""
        return self.scale.wrench(wrench) / self.unit

    def wrench(self, scaled: Array) -> Array:
        """Return the wrench (6,) about B [N, N m] of one in scaled coordinates and force units."""
        return frozen(self.unit * self.scale.motion.T @ scaled)

    def under(self, scaled: Array) -> Program:
        """Return the program of the internal forces under an extra wrench, with the bounds that hold there."""
        return self.under_wrench(self.wrench(scaled))

    def works_on_free(self, scaled: Array) -> bool:
        """Return whether an extra wrench moves the object where no contact resists."""
        return bool(np.any(np.abs(self.free.T @ scaled) > FREE * np.linalg.norm(scaled)))

    def cones(self) -> Iterator[Cones]:
        """Yield the cones of every block."""
        for block, rows in self.program.slices():
            if block.rows:
                places = np.arange(rows.start, rows.stop).reshape(-1, block.dim)
                yield Cones(block, self.program.b[places], self.columns[places], places)


def _room(program: Program) -> Array:
    """Return (m,) what puts values b (m,) that are outside of their cones on the edge of them."""
    found = np.zeros(len(program.b))
    for block, rows in program.slices():
        if block.kind is Kind.ZERO:
            found[rows] = -program.b[rows]
        elif block.rows:
            found[rows][:: block.dim] = np.maximum(outside(block, program.b[rows]), 0.0)
    return found


FREE = 1e-8
"""Share of a wrench that may work on a free motion for rounding."""
