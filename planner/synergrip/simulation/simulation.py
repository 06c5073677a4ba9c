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
    half_step_difference,
    likely_cause,
)
from synergrip.simulation.notes import notes_of
from synergrip.simulation.played_plan import PlayedPlan, read_played_plan
from synergrip.simulation.playing import Played, play
from synergrip.simulation.watching import LOST, SLIPPED, SPUN
from synergrip.values import Value

SPEEDS = ("slow", "real")
STEP = 2e-4
"""[s] when none is asked for."""
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
    as_written: bool | None
    """Whether plan.json is as it was written, by its digest; where it is not, what is promised is what it claims."""
    lost_at: Array  # (n_c,) [s] since when contacts that were lost did not touch; NaN where none was
    slipped_at: Array  # (n_c,) [s] since when contacts had slipped; NaN where none did
    ended: float | None
    """When the play was ended because the object was elsewhere [s]; None when it went to its end. Times before the
    first knot are of the simulation, from when on pads stuck no longer."""
    knots: Array = field(repr=False)  # (T,) [s] of the plan
    knots_promised: tuple[Array, Array] = field(repr=False)
    """Margins (T, n_c) [N] and motion (T, 6) there."""
    plan_digest: str | None = field(default=None, repr=False)
    """Of the plan.json that was played, as it tells it; None where that is not as it was written."""

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
    def failed_at(self) -> float | None:
        """When the first contact that has not held was lost, slipped or came to its cone [s]; None when all held."""
        parts = ((self.lost, self.lost_at), (self.slipped, self.slipped_at), (self.at_cone, self.cone_at[:, 0]))
        times = [float(at[self.contacts.index(name)]) for names, at in parts for name in names]
        return min((time for time in times if time == time), default=None)

    @property
    def failed_before(self) -> bool:
        """Whether that was before anything moved."""
        return self.failed_at is not None and self.failed_at < self.knots[0]

    @property
    def motion_error(self) -> tuple[float, float]:
        """Largest distance [m] and angle [rad] of the object from where the plan has it."""
        apart = self.du - self.promised_du
        return tuple(float(np.linalg.norm(apart[:, part], axis=1).max()) for part in (slice(0, 3), slice(3, 6)))  # type: ignore[return-value]

    @property
    def verdict(self) -> str:
        """What became of the grasp: "held", "at its cone", "slipped", "lost contact" or "went elsewhere"."""
        if self.lost:
            return "lost contact"
        failed = "slipped" if self.slipped else "at its cone" if self.at_cone else None
        return failed or ("held" if self.ended is None else "went elsewhere")

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

    true, half = plan.true_margins, None if finer is None else half_step_difference(found, finer)
    made = Simulation(
        plan.title, plan.names, plan.kinematics.joints, speed, step, friction, found.time, found.forces, found.margins,
        there(plan.margins), None if true is None else there(true), found.slips, found.spins, found.touching,
        found.du, there(plan.du), found.q, found.least, found.least_at, found.apart, found.on_cone, found.cone_at,
        frozen(plan.margins.min(axis=0)), float(plan.margins.min()), None if true is None else float(true.min()), half,
        allowed_difference(plan), differences(plan, found.least), None, notes_of(plan, found, speed),
        found.model.text, plan.unchanged, found.lost_at, found.slipped_at, found.flown, plan.times,
        (plan.margins, plan.du), plan.digest,
    )  # fmt: skip
    sliding = dict.fromkeys([*made.lost, *made.slipped, *made.at_cone])
    circumstances = Circumstances(
        friction, speed, None if half is None else half[0], tuple(sliding), made.failed_before
    )
    return replace(made, likely_cause=likely_cause(plan, made.differences, circumstances))
