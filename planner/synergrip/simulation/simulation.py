"""The front of the room: play a plan, play it again with half the step, and say what came of it."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError, kind_of, one_of
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.outcome import Plan
from synergrip.simulation.differences import (
    Circumstances,
    Difference,
    allowed_difference,
    differences,
    likely_cause,
)
from synergrip.simulation.played_plan import PlayedPlan, read_played_plan
from synergrip.simulation.playing import Played, play
from synergrip.simulation.watching import LOST
from synergrip.values import Value

SPEEDS = ("slow", "real")
STEP = 2e-4
"""[s] when none is asked for."""
SLIPPED = 5e-5
"""[m] from which on a contact has slipped; friction in the engine creeps by some 1e-6 m."""
SPUN = 0.01
"""[rad] about its normal from which on a contact has slipped."""
ON_CONE = 0.02
"""[s] of the simulation on its friction cone from which on a contact has not held, however little it crept."""


@made_by("simulate(plan)")
@dataclass(frozen=True, eq=False, repr=False)
class Simulation(Value):
    """A plan that was played in MuJoCo, beside what it promised. N instants, on the clock of the plan.

    Example:
        >>> simulate(answer).verdict  # doctest: +SKIP
        'holds'
    """

    title: str
    contacts: tuple[str, ...]
    joints: tuple[str, ...]
    speed: str
    """"slow" or "real"."""
    step: float  # [s]
    friction: float
    """What all friction was multiplied by."""
    time: Array  # (N,) [s]
    forces: Array = field(repr=False)  # (N, n_l) in the contact frames, as lambda of the plan
    margin: Array  # (N, n_c) [N]
    promised: Array  # (N, n_c) [N]
    true: Array | None  # (N, n_c) [N] at the true equilibrium, when the plan tells it
    slip: Array  # (N, n_c) [m]
    spin: Array  # (N, n_c) [rad]
    touching: Array  # (N, n_c)
    du: Array  # (N, 6) motion of the object
    promised_du: Array  # (N, 6)
    q: Array = field(repr=False)  # (N, n_q)
    least: Array  # (n_c,) [N] smallest margin of each contact
    least_at: Array  # (n_c,) [s]
    apart: Array  # (n_c,) [s] longest time without touch
    on_cone: Array  # (n_c,) [s] of the simulation in which contacts that touch had no margin
    cone_at: Array  # (n_c, 2) [s] from when to when, the longest of that; NaN where there was none
    promised_least: Array  # (n_c,) [N] smallest promised margin of each contact at the knots
    promised_worst: float  # [N] at the knots
    true_worst: float | None  # [N]
    half_step: tuple[float, float] | None
    """By how much margins [N] and the motion [m] differ at most when the step is half as long; None when not asked."""
    within: float  # [N] what a smallest margin may differ by from the promised one
    differences: tuple[Difference, ...]
    """Contacts whose smallest margins differ by more than that."""
    likely_cause: str | None
    """Why they are likely to; None when none does."""
    notes: tuple[str, ...]
    model: str = field(repr=False)
    """The model, as MJCF."""

    @cached_property
    def worst(self) -> tuple[float, str, float]:
        """Smallest margin [N], its contact and its time [s]."""
        i = int(np.argmin(self.least))
        return float(self.least[i]), self.contacts[i], float(self.least_at[i])

    @property
    def lost(self) -> tuple[str, ...]:
        """Contacts that were lost."""
        return tuple(name for name, apart in zip(self.contacts, self.apart, strict=True) if apart > LOST)

    @property
    def slipped(self) -> tuple[str, ...]:
        """Contacts that slipped."""
        slid, spun = self.crept
        pairs = zip(self.contacts, (slid > SLIPPED) | (spun > SPUN), strict=True)
        return tuple(name for name, moved in pairs if moved)

    @property
    def at_cone(self) -> tuple[str, ...]:
        """Contacts that were on their friction cones, where they creep, for more than `ON_CONE`."""
        return tuple(name for name, time in zip(self.contacts, self.on_cone, strict=True) if time > ON_CONE)

    @property
    def crept(self) -> tuple[Array, Array]:
        """How far contacts slid [m] and spun [rad] at most, (n_c,) each."""
        return self.slip.max(axis=0), np.abs(self.spin).max(axis=0)

    @property
    def motion_error(self) -> tuple[float, float]:
        """Largest distance [m] and angle [rad] of the object from where the plan has it."""
        apart = self.du - self.promised_du
        return tuple(float(np.linalg.norm(apart[:, part], axis=1).max()) for part in (slice(0, 3), slice(3, 6)))  # type: ignore[return-value]

    @property
    def verdict(self) -> str:
        """What became of the grasp: "held", "at its cone", "slipped" or "lost contact"."""
        if self.lost:
            return "lost contact"
        return "slipped" if self.slipped else "at its cone" if self.at_cone else "held"

    @property
    def exit_code(self) -> int:
        """0 when every contact held, else 3."""
        return 0 if self.verdict == "held" else 3


@naming_arguments
def simulate(
    plan: str | Path | Plan,
    *,
    speed: str = "slow",
    step: float = STEP,
    friction: float = 1.0,
    half_step: bool = True,
    progress: Callable[[str, float], None] | None = None,
) -> Simulation:
    """Play a plan in MuJoCo, by a model that is written from its plan.json alone.

    Args:
        plan: the folder or plan.json of a saved plan, or a plan.
        speed: "slow", so slowly that inertia does not count, or "real", at the speed of the plan.
        step: of the simulation [s].
        friction: what every coefficient of friction is multiplied by in the engine and in the margins.
        half_step: whether it is played again with half the step, to see that the step does not matter.
        progress: told what is under way and which share of it is done.

    Raises:
        InputError: no plan, a plan that cannot be played (a bare mass, rigid pads, a grasp given as matrices), or an
            argument that is none.

    Example:
        >>> synergrip.simulate("out/gripper-box").verdict  # doctest: +SKIP
        'held'
    """
    judge = Arguments("")
    step, friction = judge.number("step", step, above=0, unit="s"), judge.number("friction", friction, above=0)
    if speed not in SPEEDS:
        judge.refuse("speed", one_of(speed, SPEEDS))
    if step > 2e-3:
        judge.refuse("step", f"{step:g} s is too long to follow the springs of pads; try {STEP:g}")
    judge.finish()
    played = _read(plan).with_friction(friction)
    told = progress or (lambda what, share: None)
    found = play(played, step, speed, lambda done, of: told(f"playing at {step:g} s a step", done / of))
    finer = None
    if half_step:
        finer = play(played, step / 2, speed, lambda done, of: told(f"again at {step / 2:g} s", done / of))
    return _simulation(played, found, finer, speed, friction, step)


def _read(plan: str | Path | Plan) -> PlayedPlan:
    if isinstance(plan, Plan):
        with tempfile.TemporaryDirectory() as folder:
            plan.save(folder, formats="json")
            return read_played_plan(Path(folder))
    if not isinstance(plan, str | Path):
        message = f"expected the folder or plan.json of a saved plan, or a Plan, got {kind_of(plan)}"
        raise InputError.at("plan", message)
    return read_played_plan(Path(plan))


def _simulation(
    plan: PlayedPlan, found: Played, finer: Played | None, speed: str, friction: float, step: float
) -> Simulation:
    def there(values: Array) -> Array:
        return frozen(interpolated(found.time, plan.times, values))

    true, half = plan.true_margins, None if finer is None else _difference(found, finer)
    made = Simulation(
        plan.title, plan.names, plan.kinematics.joints, speed, step, friction, found.time, found.forces, found.margins,
        there(plan.margins), None if true is None else there(true), found.slips, found.spins, found.touching,
        found.du, there(plan.du), found.q, found.least, found.least_at, found.apart, found.on_cone, found.cone_at,
        frozen(plan.margins.min(axis=0)), float(plan.margins.min()), None if true is None else float(true.min()), half,
        allowed_difference(plan), differences(plan, found.least), None, tuple(_notes(plan, found, speed)),
        found.model.text,
    )  # fmt: skip
    sliding = dict.fromkeys([*made.lost, *made.slipped, *made.at_cone])
    circumstances = Circumstances(friction, speed, None if half is None else half[0], tuple(sliding))
    return replace(made, likely_cause=likely_cause(plan, made.differences, circumstances))


def _difference(found: Played, finer: Played) -> tuple[float, float]:
    """Return how far margins [N] and motion [m] of two plays are apart, where both have been."""
    count = min(len(found.time), len(finer.time))
    if count < 2:
        return float(np.abs(found.least - finer.least).max()), float("inf")
    order = np.argsort(finer.time, kind="stable")

    def apart(a: Array, b: Array) -> Array:
        # one value for each instant: what stands at the same time twice is a jump, whose last value counts
        return np.column_stack([np.interp(found.time, finer.time[order], column) for column in b[order].T]) - a

    margins = np.abs(finer.least - found.least).max()
    shift = np.linalg.norm(apart(found.du[:, :3], finer.du[:, :3]), axis=1).max()
    return float(margins), float(shift)


def _notes(plan: PlayedPlan, found: Played, speed: str) -> list[str]:
    model, notes = found.model, []
    points = [each.pad.contact.name for each in model.pads if not each.pad.radius > 0]
    if points:
        radius = next(each.radius for each in model.pads if not each.pad.radius > 0)
        notes.append(f"pads without a radius touch with a sphere of {1e3 * radius:g} mm: {', '.join(points)}")
    if plan.mass is None:
        notes.append(f"the object has no mass in the plan; {model.mass:g} kg stand in for it")
    if model.springs.count:
        notes.append(
            f"{model.springs.count} of {len(plan.q_0)} directions of the joints do not give and are prescribed"
        )
    if speed == "real":
        notes.append("the hand's own inertia is not in plan.json; links and pads are light")
    if found.flown:
        notes.append("the object left the hand, and the play was ended there")
    return notes
