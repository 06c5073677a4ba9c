"""References executed: the equilibria that a hand goes through, instant by instant."""

from __future__ import annotations

from dataclasses import dataclass, fields
from fractions import Fraction
from functools import cached_property

import numpy as np

from synergrip.documents.judging import Arguments, described
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.between import states_between
from synergrip.equilibrium.first_squeeze import SQUEEZE, led, led_states, squeezes
from synergrip.equilibrium.newton import at_rest, on_faces, settled, why_not
from synergrip.equilibrium.setting import ContactModel, Setting, setting
from synergrip.equilibrium.states import Loads, States
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, Places, frozen
from synergrip.statics.response import Maps, Response
from synergrip.values import Value

SHORTEST = Fraction(1, 640)
"""Share of a step from one instant to the next below which it is given up."""


@made_by("execute(grasp, times, references, loads)")
@dataclass(frozen=True, eq=False, repr=False)
class Execution(Value):
    """The equilibria at those of T instants that were reached, K of them.

    Example:
        >>> executed = execute(grasp, [0.0], [[0.0, 0.01, 0.01, 0.01]], Loads.of(np.zeros((1, 6))))
        >>> executed.whole, executed.du.shape, executed.states.forces.shape
        (True, (1, 6), (1, 9))
    """

    times: Array  # (T,) [s]
    references: Array  # (T, n_z)
    path: Balance
    """The equations at all equilibria that were gone through, those of the first squeeze, too."""
    kept: Places
    """(K,) which of them are those of the instants."""
    iterations: int
    why: str = ""
    """Why the others were not reached; empty when all were."""

    @property
    def setting(self) -> Setting:
        """The grasp at its start."""
        return self.path.setting

    @cached_property
    def balance(self) -> Balance:
        """(K) The equations at the instants."""
        return self.path.taken(self.kept)

    @property
    def states(self) -> States:
        """(K) joints, object and forces."""
        return self.balance.states

    @property
    def whole(self) -> bool:
        """Whether all instants were reached."""
        return len(self.states) == len(self.times)

    @cached_property
    def maps(self) -> Maps:
        """(K, ...) how forces and motions answer to references and load at the equilibria."""
        return Maps(**{each.name: getattr(self.path.maps, each.name)[self.kept] for each in fields(Maps)})

    @cached_property
    def regular(self) -> Array:
        """(K,) whether the tangent of the equilibria has an inverse."""
        return np.asarray(self.path.regular[self.kept])

    @cached_property
    def joint(self) -> Array:
        """(K, n_q) joint displacement from the start [rad or m]."""
        return frozen(self.states.q - self.setting.held.q)

    def interpolated(self, times: Array, wrench: Array | None = None) -> States:
        """Return states between the equilibria, at some times (M,): where Newton's method may begin.

        Where contacts roll, those of the first squeeze come before them. Beyond the last of them there is that one.

        Args:
            times: [s].
            wrench: (M, 6) on the object there; straight from one instant to the next when it is not given.

        Raises:
            InputError: times or wrenches that are none, or an execution that reached none of its instants.
        """
        judge = Arguments("Execution.interpolated")
        times = judge.array("times", times, np.shape(np.atleast_1d(times))[:1], ": times (M,) [s]")
        if wrench is not None and not judge.issues:
            wrench = judge.array("wrench", wrench, (len(times), 6), ", a row for each time")
        judge.finish()
        if not (count := len(self.states)):
            raise InputError.at("Execution.interpolated", f"no instant was reached, so no state is known: {self.why}")
        there = states_between(self.times[:count], self.balance, self.maps, self.regular, times, wrench)
        lead = len(self.path.states) - count
        return States.joined([self.path.states.taken(slice(0, lead)), there]) if lead else there

    def left(self, wanted: Array) -> Array:
        """Return the twist (K, 6) from where the object is to where it is wanted.

        Args:
            wanted: (T, 6) displacements from the start: translation and rotation vector [m, rad].
        """
        from scipy.spatial.transform import Rotation

        judge = Arguments("Execution.left")
        aim = np.array(judge.array("wanted", wanted, (len(self.times), 6), ", one for each time")[: len(self.states)])
        judge.finish()
        turn = Rotation.from_rotvec(aim[:, 3:]) * Rotation.from_matrix(np.array(self.states.rotation)).inv()
        return frozen(np.hstack([aim[:, :3] - self.du[:, :3], turn.as_rotvec()]))

    @cached_property
    def margins(self) -> Array:
        """(K, n_c) slip margins [N]; contacts stick here whatever it is, and would slip where it is negative."""
        return frozen(self.setting.slip_margins(self.states.forces))

    @cached_property
    def residual(self) -> float:
        """The largest error of the equilibria, relative to lengths and forces of the grasp."""
        return float(self.path.error[self.kept].max(initial=0.0))

    @cached_property
    def stiffness(self) -> Array:
        """(K,) the smallest stiffness with which the object is held [N/m]; not above 0 where it is not stable.

        It is 0 in a state whose tangent has no inverse.
        """
        length = self.setting.length
        wrench = np.diag([1.0, 1.0, 1.0, length, length, length])
        given = wrench @ self.maps.du_dw @ wrench  # scaled twist for each scaled wrench
        values = np.linalg.eigvalsh((given + given.mT) / 2)
        soft = np.where(values.min(axis=1) < 0, values.min(axis=1), values.max(axis=1))
        return frozen(np.where(self.regular, 1.0 / np.where(self.regular, soft, 1.0), 0.0))

    @cached_property
    def du(self) -> Array:
        """(K, 6) displacement of the object from the start: translation and rotation vector [m, rad]."""
        from scipy.spatial.transform import Rotation

        turn = Rotation.from_matrix(np.array(self.states.rotation)).as_rotvec()
        return frozen(np.hstack([self.states.position - self.setting.held.body.position, turn]))


@naming_arguments
def execute(
    grasp: Grasp | Setting, times: Array, references: Array, loads: Loads, *, contact_model: ContactModel = "rolling",
    response: Response | None = None, guess: States | Execution | None = None,
) -> Execution:  # fmt: skip
    """Return the equilibria of a hand that synergy references lead through.

    Args:
        grasp: on a hand, as it is before the first reference; or its `setting`, which has a model and forces already.
        times: (T,) [s], increasing; an instant at which the load jumps may stand twice, with the same references.
        references: (T, n_z) of the synergies, from those at the start [rad, m or as the synergies are scaled].
        loads: (T) on the object.
        contact_model: "rolling" or "fixed", see `setting`.
        response: of the grasp, when it is known.
        guess: (T) states near the equilibria, or an execution of references near these; all are then tried at once
            first. What is found is the same, up to the way that tips roll where shorter steps are needed.

    Returns:
        the equilibria; it ends where there is none to be found, and says why.

    Raises:
        InputError: a grasp given as matrices, no such contact model, arguments that do not fit each other.

    Example:
        >>> execute(grasp, [0.0], [[0.0, 0.01, 0.01, 0.01]], Loads.of(np.zeros((1, 6)))).margins.shape
        (1, 3)
    """
    own = grasp if isinstance(grasp, Setting) else setting(grasp, contact_model, response)
    times, references = _judged(own, times, references, loads, guess)
    lead = squeezes(own)
    way = led(own, references, loads, lead)
    if guess is not None:
        near, known = _near(own, guess, lead, len(times))
        balance, count = settled(own, near, way.loads, way.references, known)
        if np.all(at_rest(balance)) and on_faces(balance) == len(near):
            return Execution(times, references, balance, np.arange(lead, lead + len(times)), count)
    return _followed(own, times, references, loads)


def _judged(
    own: Setting, times: Array, references: Array, loads: Loads, guess: States | Execution | None
) -> tuple[Array, Array]:
    """Return times (T,) and references (T, n_z) as arrays, when all arguments fit each other."""
    judge = Arguments("")
    instants = judge.numbers("times", times, "times (T,)")
    if instants is not None and (instants.ndim != 1 or not len(instants)):
        judge.refuse("times", f"expected times (T,) [s], one at least; got {described(times)}")
    elif instants is not None and np.any(early := np.diff(instants) < 0):
        before, after = instants[int(np.argmax(early)) :][:2]
        judge.refuse("times", f"times must increase: {after:g} s comes after {before:g} s; sort them")
    count = len(instants) if instants is not None and not judge.issues else 0
    if instants is not None and count:
        wanted = (count, own.grasp.n_z)
        references = judge.array("references", references, wanted, ", a row for each time, a column for each synergy")
        twice = (np.diff(instants) == 0) & np.any(np.diff(references, axis=0) != 0, axis=1)
        if np.any(twice):
            at = f"{instants[int(np.argmax(twice))]:g} s stands twice with two references"
            judge.refuse("times", f"{at}; give each instant one, or move one of them (only loads may jump)")
    else:
        judge.numbers("references", references, "references (T, n_z)")
    if judge.one("loads", loads, Loads, "Loads.of(np.zeros((T, 6)))") is not None and count and len(loads) != count:
        judge.refuse("loads", f"expected loads at {count} times, got {len(loads)}")
    states, example = guess.states if isinstance(guess, Execution) else guess, "another execution, or its states"
    if states is not None and judge.one("guess", states, States, example) is not None and count:
        known, start = [(count, own.grasp.n_q), (squeezes(own) + count, own.grasp.n_q)], own.start
        if states.q.shape not in known or states.forces.shape != (len(states), start.forces.shape[1]):
            judge.refuse("guess", f"expected states of this grasp at {count} times, got joints {states.q.shape}")
    judge.finish()
    return np.asarray(instants), references


def _near(own: Setting, guess: States | Execution, lead: int, count: int) -> tuple[States, Balance | None]:
    """Return states to begin at, those of the first squeeze, too, and the equations there when they are known."""
    if isinstance(guess, Execution):
        if len(guess.path.states) == lead + count:
            return guess.path.states, guess.path
        guess = guess.states
    return guess if len(guess) == lead + count else led_states(own, guess, lead), None


def _followed(own: Setting, times: Array, references: Array, loads: Loads) -> Execution:
    """Follow the equilibria from the start, in steps as short as it takes."""
    here, state, z, w = own, own.start, np.zeros((1, references.shape[1])), own.unloaded(loads)
    path, count, kept, why = list[tuple[States, Array, Loads]](), 0, list[int](), ""
    for k in range(len(times)):
        gone, step = Fraction(0), Fraction(1, SQUEEZE if k == 0 else 1)
        from_z, from_w, to_w = z, w, loads.taken([k])
        while gone < 1 and not why:
            there = float(min(Fraction(1), gone + step))
            z, w = (1 - there) * from_z + there * references[[k]], from_w.between(to_w, there)
            balance, iterations = settled(here, state, w, z)
            count += iterations
            if at_rest(balance)[0] and on_faces(balance):
                here, state, gone = balance.moved_on(), balance.states, gone + step
                path.append((state, z, w))
            elif step / 2 >= SHORTEST:
                step /= 2
            else:
                why = why_not(balance)
        if why:
            break
        kept.append(len(path) - 1)
    states, zs, ws = (
        zip(*path[: kept[-1] + 1], strict=True) if kept else ((own.start,), (0 * z,), (own.unloaded(loads),))
    )
    whole = Balance.of(own, States.joined(states), Loads.joined(ws), np.concatenate(zs))
    return Execution(times, references, whole, np.array(kept, dtype=int), count, why)
