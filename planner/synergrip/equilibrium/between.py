"""States between equilibria that are known, from how these answer to references and load: Hermite's cubics."""

from __future__ import annotations

import numpy as np

from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.states import States
from synergrip.linalg import Array, Places
from synergrip.statics.response import Maps
from synergrip.vectors import off_chord, rotation_matrices, rotation_vectors


def states_between(
    known: Array, equilibria: Balance, maps: Maps, regular: Array, times: Array, wrench: Array | None
) -> States:
    """Return states (M) that leave each equilibrium as its derivatives say.

    What they miss is as the fourth power of the time from one equilibrium to the next. Where the tangent of one has no
    inverse they are on the straight line to the next.

    Args:
        known: (K,) when the hand is at the equilibria, one at least [s].
        equilibria: (K) the equations there.
        maps: (K) how forces and motions answer there.
        regular: (K,) whether the tangents have inverses.
        times: (M,) [s].
        wrench: (M, 6) on the object; straight from one equilibrium to the next when it is None.
    """
    states = equilibria.states
    last = np.clip(np.searchsorted(known, times, side="right"), min(1, len(known) - 1), len(known) - 1)
    first = np.maximum(last - 1, 0)
    share = np.clip((times - known[first]) / np.maximum(known[last] - known[first], 1e-300), 0.0, 1.0)[:, None]
    before = states.rotation[first]
    turn = rotation_vectors(states.rotation[last] @ before.mT)
    linear = [getattr(states, name)[last] - getattr(states, name)[first] for name in ("q", "position", "forces")]
    chord = np.hstack([*linear[:2], turn, linear[2]])
    bend = _bend(equilibria, maps, (first, last), share, chord, wrench)
    moved = share * chord + np.where(np.logical_and(regular[first], regular[last])[:, None], bend, 0.0)
    q, position, turned, forces = np.split(moved, np.cumsum([states.q.shape[1], 3, 3]), axis=1)
    rotation = rotation_matrices(turned) @ before
    return States(states.q[first] + q, states.position[first] + position, rotation, states.forces[first] + forces)


def _bend(
    equilibria: Balance, maps: Maps, ends: tuple[Places, Places], share: Array, chord: Array, wrench: Array | None
) -> Array:
    """Return how far (M, n_q + 6 + n_l) states are off the chords from one equilibrium to the next.

    Args:
        equilibria: (K) the equations.
        maps: (K) of them.
        ends: (M,) the equilibrium before each state, and the one after it.
        share: (M, 1) how far it is from there to the next.
        chord: (M, n_q + 6 + n_l) of joints, object and forces.
        wrench: (M, 6) on the object, if it is known.
    """
    of_references, of_load = (
        np.concatenate([getattr(maps, f"d{name}_{by}") for name in ("q", "u", "lambda")], axis=1)
        for by in ("dzr", "dw")
    )
    (first, last), z, w = ends, equilibria.references, equilibria.loads.wrench
    dz, dw = z[last] - z[first], w[last] - w[first]
    leaving, arriving = (_times(of_references[end], dz) + _times(of_load[end], dw) for end in ends)
    bend = off_chord(share, chord, leaving, arriving)
    if wrench is not None:
        beside = wrench - w[first] - share * dw
        bend += (1 - share) * _times(of_load[first], beside) + share * _times(of_load[last], beside)
    return bend


def _times(matrices: Array, vectors: Array) -> Array:
    """Return matrices (M, m, n) times vectors (M, n)."""
    return np.asarray((matrices @ vectors[:, :, None])[:, :, 0])
