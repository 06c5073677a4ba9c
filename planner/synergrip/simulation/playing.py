"""The play: squeeze with more friction, let the true friction take over, then references and load."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
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
SAMPLES = 400
"""Instants of the play that are kept."""

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
    duration: float  # [s] of the play on the clock of the simulation
    flown: bool
    """Whether the object went so far from where it was to be that the play was ended."""
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
    run.keep = max(int(line.duration / step / SAMPLES), 1)
    run.look(line.applied(0.0).at)
    run.through(line)
    run.still(line)
    run.look(float(line.at[-1]))
    return run.seen(line.duration)


class _Run:
    """A simulation under way."""

    def __init__(self, plan: PlayedPlan, model: Model, progress: Progress | None) -> None:
        import mujoco

        self.plan, self.model, self.progress = plan, model, progress
        self.data = mujoco.MjData(model.mujoco)
        self.data.qpos[model.places] = plan.q_0
        self.slipped, self.turned = np.zeros((len(plan.pads), 3)), np.zeros(len(plan.pads))
        self.rows: list[tuple[Any, ...]] = []
        self.watch, self.flown = Watch(len(plan.pads)), False
        self.keep, self.count, self.total = 0, 0, 1.0
        self.damping = model.lag * model.springs.K
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
        steps = int(np.ceil(RELEASE / self.model.step))
        for number in range(steps):
            self.data.ctrl[:] = glue * (1 - (number + 1) / steps)
            self.advance(line, line.duration)
        self.still(line)

    def damped(self, rate: float) -> None:
        """Hold back the object with a rate [1/s] of its inertia."""
        dof, mujoco = self.model.body_dof, self.model.mujoco
        inertia = mujoco.body_inertia[self.model.body].max()
        mujoco.dof_damping[dof : dof + 3] = rate * self.model.mass
        mujoco.dof_damping[dof + 3 : dof + 6] = rate * inertia

    def through(self, line: Timeline) -> None:
        steps = int(np.ceil(line.duration / self.model.step))
        for number in range(steps):
            if not self.flown:
                self.advance(line, (number + 1) * self.model.step)

    def still(self, line: Timeline) -> None:
        for _ in range(int(np.ceil(SETTLE / self.model.step))):
            self.advance(line, line.duration)

    def advance(self, line: Timeline, clock: float) -> None:
        """Apply what is due at a time, and take one step."""
        import mujoco

        plan, model, data = self.plan, self.model, self.data
        now, springs = line.applied(min(clock, line.duration)), model.springs
        q_r = plan.q_0 + plan.S @ now.dz_r
        rate = (q_r - self.q_r) / model.step
        self.q_r = q_r
        q, v = data.qpos[model.places], data.qvel[model.dofs]
        tau = springs.held @ plan.tau_0 - springs.K @ (q - q_r) - self.damping @ (v - rate)
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
            self.follow(now.at)
        if self.keep and self.count % self.keep == 0:
            self.look(now.at)

    def follow(self, at: float) -> None:
        """Add up how the contacts slide, and see which margin is smallest, at a time of the plan [s]."""
        data, span = self.data, EVERY * self.model.step
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
        if self.keep:
            self.watch.see(*self.judged(found), at, span)
            wanted = np.array([np.interp(at, self.plan.times, column) for column in self.plan.du[:, :3].T])
            self.flown = bool(np.linalg.norm(self.moved()[:3] - wanted) > FLOWN)
        if self.progress and self.count % (100 * EVERY) == 0:
            self.progress(min(float(data.time), self.total), self.total)

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

    def look(self, at: float) -> None:
        """Keep what is seen now."""
        self.pads.follow(self.data)
        found = touches(self.model, self.data, self.pads.frames)
        margins, touching = self.judged(found)
        forces = [np.zeros(pad.contact.n_rows) if t is None else t.force
                  for pad, t in zip(self.plan.pads, found, strict=True)]  # fmt: skip
        self.watch.smallest(margins, touching, at)
        self.rows.append((at, np.concatenate(forces), margins, np.linalg.norm(self.slipped, axis=1),
                          self.turned.copy(), touching, self.moved(),
                          self.data.qpos[self.model.places].copy()))  # fmt: skip

    def seen(self, duration: float) -> Played:
        """Return what was kept."""
        time, forces, margins, slips, spins, touching, du, q = (
            frozen(np.array(column)) for column in zip(*self.rows, strict=True)
        )
        watch = self.watch
        least = frozen(np.where(np.isfinite(watch.least), watch.least, 0.0))
        return Played(time, forces, margins, slips, spins, touching, du, q, least, frozen(watch.least_at),
                      frozen(watch.apart), frozen(watch.on_cone), frozen(watch.cone_at), duration, self.flown,
                      self.model)  # fmt: skip
