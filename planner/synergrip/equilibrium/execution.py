"""References executed: the equilibria that a hand goes through, instant by instant."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import made_by
from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.between import states_between
from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.stability import lacking_stiffness
from synergrip.equilibrium.states import States
from synergrip.equilibrium.way import squeezes
from synergrip.errors import InputError
from synergrip.linalg import Array, Places, frozen
from synergrip.statics.response import Maps
from synergrip.values import Value
from synergrip.vectors import rotation_matrices, rotation_vectors

ALIKE = 0.01
"""Share by which motions may be resisted differently and be alike: which of them is softest, rounding would say."""


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

    def first(self, count: int) -> Execution:
        """Return the execution of the first instants alone, all of them reached."""
        if count == len(self.times):
            return self
        kept = self.kept[:count]
        path = self.path.taken(np.arange(int(kept[-1]) + 1))
        return Execution(self.times[:count], self.references[:count], path, kept, self.iterations)

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
        first = int(self.kept[0])
        lead = min(squeezes(self.setting), first)
        return States.joined([self.path.states.taken(slice(first - lead, first)), there]) if lead else there

    def left(self, wanted: Array) -> Array:
        """Return the twist (K, 6) from where the object is to where it is wanted.

        Args:
            wanted: (T, 6) displacements from the start: translation and rotation vector [m, rad].
        """
        judge = Arguments("Execution.left")
        aim = np.array(judge.array("wanted", wanted, (len(self.times), 6), ", one for each time")[: len(self.states)])
        judge.finish()
        turn = rotation_vectors(rotation_matrices(aim[:, 3:]) @ self.states.rotation.mT)
        return frozen(np.hstack([aim[:, :3] - self.du[:, :3], turn]))

    @cached_property
    def margins(self) -> Array:
        """(K, n_c) slip margins [N]; contacts stick here whatever it is, and would slip where it is negative."""
        return frozen(self.setting.grasp.slip_margins(self.states.forces))

    @cached_property
    def residual(self) -> float:
        """The largest error of the equilibria, relative to lengths and forces of the grasp."""
        return float(self.path.error[self.kept].max(initial=0.0))

    @cached_property
    def stiffness(self) -> Array:
        """(K,) the smallest stiffness with which the object is held [N/m]; not above 0 where it is not stable.

        It is 0 in a state whose tangent has no inverse, and the least of hand and object together where these give way
        there, or on the way there (`lacking_stiffness`).
        """
        values = np.linalg.eigvalsh(self._given)
        soft = np.where(values.min(axis=1) < 0, values.min(axis=1), values.max(axis=1))
        held = np.where(self.regular, 1.0 / np.where(self.regular, soft, 1.0), 0.0)
        return frozen(np.where(self._lacking < 0, np.minimum(held, self._lacking), held))

    @property
    def softest(self) -> Array | None:
        """The motions of the object against which it is held least, where it is.

        (m, 6) independent twists about its origin [m, rad], axes of the palm, of length 1 where turns count with the
        length of the grasp: one, or all that are resisted alike. None where it is not held against all of them.
        """
        k = int(np.argmin(self.stiffness))
        if self._lacking[k] < 0 or not self.regular[k]:
            return None
        values, vectors = np.linalg.eigh(self._given[k])
        if values[0] < 0:
            return None
        twists = vectors.T[values >= (1 - ALIKE) * values[-1]][::-1]
        return frozen(twists / np.array([1.0, 1.0, 1.0, *[self.setting.length] * 3]))

    @cached_property
    def _given(self) -> Array:
        """(K, 6, 6) how far the object gives to wrenches [m/N], turns and moments by the length of the grasp."""
        length = self.setting.length
        wrench = np.diag([1.0, 1.0, 1.0, length, length, length])
        given = wrench @ self.maps.du_dw @ wrench  # scaled twist for each scaled wrench
        return np.asarray((given + given.mT) / 2)

    @cached_property
    def _lacking(self) -> Array:
        """(K,) the least stiffness of hand and object together on the way to each instant, where it is not above 0."""
        begins = np.concatenate([[0], self.kept[:-1] + 1])
        return np.asarray(np.minimum.reduceat(lacking_stiffness(self.path), begins))

    @cached_property
    def du(self) -> Array:
        """(K, 6) displacement of the object from the start: translation and rotation vector [m, rad]."""
        turn = rotation_vectors(self.states.rotation)
        return frozen(np.hstack([self.states.position - self.setting.held.body.position, turn]))
