"""The play: squeeze with more friction, let the true friction take over, then references and load."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.simulation.keeping import Kept, Row
from synergrip.simulation.model import Model, make_model
from synergrip.simulation.observing import Touch, touches
from synergrip.simulation.pad_springs import PadSprings
from synergrip.simulation.played_plan import PlayedPlan
from synergrip.simulation.timeline import Timeline, timeline, to_the_first_knot
from synergrip.simulation.watching import Watch, without_rounding
from synergrip.values import Value

GLUE = 10.0
"""How many times the largest force at the start the pads are pressed on the object while it is squeezed."""
RELEASE = 0.1
"""[s] in which that ends."""
SETTLE = 0.25
"""[s] to come to rest, after the squeeze and after the friction is let go, and at the end."""
SQUEEZE = 0.5
"""[s] at least."""
EVERY = 10
"""Steps from one look at the contacts to the next."""
FLOWN = 0.05
"""How far from where it was to be [m] an object is that has left the hand."""

Progress = Callable[[float, float], None]


@dataclass(frozen=True, eq=False, repr=False)
class Played(Value):
    """What was seen at N instants of the play, on the clock of the plan."""

    time: Array  # (N,) [s] of the plan
    forces: Array  # (N, n_l); 0 where a pad does not touch
    margins: Array  # (N, n_c) [N]; 0 where a pad does not touch
    slips: Array  # (N, n_c) [m] since the friction is the true one
    spins: Array  # (N, n_c) [rad] turned about the normal since then
    touching: Array  # (N, n_c) bool
    du: Array  # (N, 6) motion of the object since the start
    q: Array  # (N, n_q)
    least: Array  # (n_c,) [N] smallest margins, looked for more often than what is kept
    least_at: Array  # (n_c,) [s] of the plan when that was
    apart: Array  # (n_c,) [s] of the simulation: the longest time without touch
    on_cone: Array  # (n_c,) [s] of the simulation: how long contacts that touch had no margin
    cone_at: Array  # (n_c, 2) [s] of the plan: from when to when the longest of that was; NaN where there was none
    lost_at: Array  # (n_c,) [s] of the plan: since when contacts that were lost did not touch; NaN where none was
    slipped_at: Array  # (n_c,) [s] of the plan: since when slips were too large; NaN where none was
    flown: float | None
    """When the object was so far from where it was to be that the play was ended [s] of the plan; None when it was
    not. Times before the plan's first are of the simulation, from when on pads stuck no longer."""
    model: Model = field(repr=False)


def play(plan: PlayedPlan, step: float, speed: str, progress: Progress | None = None) -> Played:
    """Play a plan.

    Raises:
        InputError: contacts that cannot be played, or motion so wild that the engine gave up.
    """
    model = make_model(plan, step)
    run = _Run(plan, model, progress)
    line = timeline(plan, speed)
    size = float(np.abs(line.dz_r[0]).max(initial=0.0))
    squeeze = to_the_first_knot(plan, line, run.wrench_0, max(SQUEEZE, size, float(np.abs(plan.forces[0]).max()) / 20))
    run.total = squeeze.duration + RELEASE + 4 * SETTLE + line.duration
    run.squeeze(squeeze)
    if run.flown is None:
        run.begin(line)
        run.through(line)
        run.still(line)
        run.end()
    if progress:
        progress(run.total, run.total)
    return run.seen()


class _Run:
    """A simulation under way."""

    def __init__(self, plan: PlayedPlan, model: Model, progress: Progress | None) -> None:
        import mujoco

        self.plan, self.model, self.progress = plan, model, progress
        self.data = mujoco.MjData(model.mujoco)
        self.data.qpos[model.places] = plan.q_0
        self.slipped, self.turned = np.zeros((len(plan.pads), 3)), np.zeros(len(plan.pads))
        self.watch = Watch(len(plan.pads))
        self.flown: float | None = None
        self.kept: Kept | None = None  # while pads stick
        self.count, self.total = 0, 1.0
        self.tau_0 = model.springs.held @ plan.tau_0
        self.q_r = plan.q_0
        mujoco.mj_forward(model.mujoco, self.data)
        self.pads = PadSprings(model)
        self.pads.follow(self.data)
        self.wrench_0 = -sum((self._wrench(pad.frame_o, pad.pad.contact.point, force)
                              for pad, force in zip(model.pads, plan.forces_0, strict=True)), np.zeros(6))  # fmt: skip

    @staticmethod
    def _wrench(frame: Array, point: Array, force: Array) -> Array:
        full = np.zeros(4)
        full[: len(force)] = force
        pushed = frame @ full[:3]
        return np.concatenate([pushed, np.cross(point, pushed) + full[3] * frame[:, 0]])

    def squeeze(self, line: Timeline) -> None:
        """Squeeze with pads that stick whatever they carry, let go of that, and come to rest.

        The reaction to the load at the start need not be one that friction can hold before there is a squeeze.
        """
        sizes = [np.abs(self.plan.forces[0]).max(), *(np.abs(force).max() for force in self.plan.forces_0), 1.0]
        glue = GLUE * float(max(sizes))
        self.data.ctrl[:] = glue
        self.damped(1 / self.model.lag)
        self.through(line)
        self.still(line)
        self.damped(0.0)
        self.still(line)
        self.slipped[:] = self.turned[:] = 0.0
        first, steps, rest = float(line.at[-1]), *(int(np.ceil(time / self.model.step)) for time in (RELEASE, SETTLE))
        self.kept = Kept(len(self.plan.pads), RELEASE + SETTLE, RELEASE + SETTLE)
        for number in range(steps + rest):
            if self.flown is None:
                self.data.ctrl[:] = glue * max(1 - (number + 1) / steps, 0.0)
                self.advance(line, line.duration, first - (steps + rest - 1 - number) * self.model.step)

    def begin(self, line: Timeline) -> None:
        """Begin what is told: the object is held by what the plan has at its start."""
        self.watch = self.watch.afresh()
        self.kept = Kept(len(self.plan.pads), line.duration, float(line.at[-1] - line.at[0]))
        self.follow(float(line.at[0]), 0.0)

    def end(self) -> None:
        """Keep what is seen at the end."""
        if self.flown is None:
            self.follow(float(self.plan.times[-1]), 0.0, always=True)

    def damped(self, rate: float) -> None:
        """Hold back the object with a rate [1/s] of its inertia."""
        dof, mujoco = self.model.body_dof, self.model.mujoco
        inertia = mujoco.body_inertia[self.model.body].max()
        mujoco.dof_damping[dof : dof + 3] = rate * self.model.mass
        mujoco.dof_damping[dof + 3 : dof + 6] = rate * inertia

    def through(self, line: Timeline) -> None:
        steps = int(np.ceil(line.duration / self.model.step))
        for number in range(steps):
            if self.flown is None:
                self.advance(line, (number + 1) * self.model.step)

    def still(self, line: Timeline) -> None:
        for _ in range(int(np.ceil(SETTLE / self.model.step))):
            if self.flown is None:
                self.advance(line, line.duration)

    def advance(self, line: Timeline, clock: float, at: float | None = None) -> None:
        """Apply what is due at a time, and take one step, which ends at a time of the plan."""
        import mujoco

        plan, model, data = self.plan, self.model, self.data
        now, springs = line.applied(min(clock, line.duration)), model.springs
        q_r = plan.q_0 + plan.S @ now.dz_r
        rate = (q_r - self.q_r) / model.step
        self.q_r = q_r
        q, v = data.qpos[model.places], data.qvel[model.dofs]
        tau = self.tau_0 - springs.K @ (q - q_r + model.lag * (v - rate))
        if springs.count:
            tau -= springs.prescribed @ (data.qfrc_constraint + data.qfrc_actuator)[model.dofs]
        data.qfrc_applied[model.dofs] = tau
        data.xfrc_applied[model.body] = now.wrench
        if len(plan.load.at):
            turned = data.xmat[model.body].reshape(3, 3)
            data.xfrc_applied[model.body, 3:] += np.cross(plan.load.at @ turned.T - plan.load.at, now.forces).sum(
                axis=0
            )
        self.pads.apply(data)
        mujoco.mj_step(model.mujoco, data)
        if springs.count:
            data.qpos[model.places] += springs.prescribed @ (q_r - data.qpos[model.places])
            data.qvel[model.dofs] += springs.prescribed @ (rate - data.qvel[model.dofs])
        self.count += 1
        if self.count % EVERY == 0:
            self.follow(now.at if at is None else at, EVERY * model.step)

    def follow(self, at: float, span: float, always: bool = False) -> None:
        """Add up how the contacts slide, and see them, at a time of the plan, `span` after the last time [s]."""
        data = self.data
        if not np.isfinite(data.qvel).all() or np.abs(data.qvel).max() > 1e6:
            raise InputError.at(
                "step", f"the simulation ran away with steps of {self.model.step:g} s; try smaller ones"
            )
        self.pads.follow(data)
        found = touches(self.model, data, self.pads.frames)
        for number, touch in enumerate(found):
            if touch is not None:
                self.slipped[number] += span * touch.sliding
                self.turned[number] += span * touch.spinning
        if self.kept:
            self.see(self.kept, found, at, span, always)
        if self.progress and self.count % (100 * EVERY) == 0:
            self.progress(min(float(data.time), self.total), self.total)

    def see(self, kept: Kept, found: list[Touch | None], at: float, span: float, always: bool) -> None:
        """See which margin is smallest and what is lost, and keep the instant when it is to be kept."""
        margins, touching = self.judged(found)
        slips, du, clock = np.linalg.norm(self.slipped, axis=1), self.moved(), float(self.data.time)
        lower = self.watch.see(margins, touching, at, span)
        self.watch.slid(slips, self.turned, at)
        wanted = [np.interp(at, self.plan.times, column) for column in self.plan.du[:, :3].T]
        if np.linalg.norm(du[:3] - wanted) > FLOWN:
            self.flown = at
        even = always or self.flown is not None or (kept.due(clock, at) and not self.watch.parted)
        if not even and not lower.any():
            return
        forces = [np.zeros(pad.contact.n_rows) if touch is None else touch.force
                  for pad, touch in zip(self.plan.pads, found, strict=True)]  # fmt: skip
        row = Row(at, np.concatenate(forces), margins, slips, self.turned.copy(), touching, du,
                  self.data.qpos[self.model.places].copy())  # fmt: skip
        kept.keep_worst(lower, self.count, row)
        if even:
            kept.keep(self.count, clock, row)

    def judged(self, found: list[Touch | None]) -> tuple[Array, NDArray[np.bool_]]:
        """Return slip margins (n_c,) and which contacts touch."""
        pairs = list(zip(self.plan.pads, found, strict=True))
        margins = [0.0 if t is None else without_rounding(float(pad.contact.slip_margin(t.force)), t.force)
                   for pad, t in pairs]  # fmt: skip
        return np.array(margins), np.array([t is not None and t.force[0] > 0 for _, t in pairs])

    def moved(self) -> Array:
        """Return shift and rotation vector (6,) of the object since the start."""
        import mujoco

        place, turn = self.data.qpos[self.model.body_place :][:7], np.zeros(3)
        mujoco.mju_quat2Vel(turn, place[3:], 1.0)
        return np.concatenate([place[:3] - self.plan.position, turn])

    def seen(self) -> Played:
        """Return what was kept."""
        assert self.kept is not None, "a squeeze ends with what is kept"
        watch = self.watch
        least = np.where(np.isfinite(watch.least), watch.least, 0.0)
        time, forces, margins, slips, spins, touching, du, q = map(frozen, self.kept.columns())
        return Played(time, forces, margins, slips, spins, touching, du, q, frozen(least), frozen(watch.least_at),
                      frozen(watch.apart), frozen(watch.on_cone), frozen(watch.cone_at), frozen(watch.lost_at),
                      frozen(watch.slipped_at), self.flown, self.model)  # fmt: skip
