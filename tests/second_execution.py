"""A second execution of a plan, written to judge the first: from plan.json and a URDF file to the true equilibria.

It knows nothing of the package (a test sees to that). It reads `execution`, `time_s`, `dz_r` and `wrench`, and finds
the equilibrium at each knot by Newton's method with derivatives by differences, knot after knot, each in parts.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation
from second.equilibrium import Equilibrium, Load, State
from second.tree import read_tree

Array = np.ndarray

FIRST, PARTS = 10, 3
"""Into how many parts the way to the first knot and the one from knot to knot are divided."""
HALVINGS = 8
ITERATIONS = 25
LARGEST_TURN, LARGEST_SHIFT = 0.3, 0.03
"""What one iteration may do to joints and object [rad], [m]; a part that asks for more is halved."""


class NotReachedError(Exception):
    """There is no equilibrium that this program could follow."""


@dataclass(frozen=True)
class Executed:
    """What became of the K knots that were reached."""

    times: Array  # (K,)
    forces: Array  # (K, n_l)
    q: Array  # (K, n_q)
    du: Array  # (K, 6) shift and rotation vector of the object from the start
    tau: Array  # (K, n_q)
    margins: Array  # (K, n_c)
    ended: str | None
    """Why not all knots were reached."""


def executed(
    document: dict[str, Any], repository: Path, model: str = "rolling", first: int = FIRST, parts: int = PARTS
) -> Executed:
    """Execute the references of a plan.json; contacts of round pads roll, or are "fixed" (model)."""
    block = document["execution"]
    tree = read_tree(repository / block["hand_file"], block["root_link"], block["joints"])
    equilibrium = Equilibrium(block, tree, model)
    state, z, load = equilibrium.start, np.zeros(np.array(document["dz_r"]).shape[1]), equilibrium.load_0
    reached, ended = list[State](), None
    for k, time in enumerate(document["time_s"]):
        target, wanted = np.array(document["dz_r"][k], dtype=float), load_at(document, k)
        start = Load(load.wrench, wanted.at, load.forces if len(load.forces) else np.zeros_like(wanted.forces))
        try:
            for part in range(count := parts if k else first):
                here, there = part / count, (part + 1) / count
                ends = [(z + s * (target - z), start.toward(wanted, s)) for s in (here, there)]
                state = followed(equilibrium, state, ends[0], ends[1], HALVINGS)
        except NotReachedError as error:
            ended = f"not reached at {time:g} s: {error}"
            break
        reached.append(state)
        z, load = target, wanted
    return _told(document, equilibrium, reached, ended)


def with_fewer_lines(document: dict[str, Any], most: int) -> dict[str, Any]:
    """Return a plan.json with about so many lines of its load at most, where none of them is a jump."""
    load = document["execution"]["load"]
    assert np.all(np.diff(load["times_s"]) > 0)
    every = np.unique(np.round(np.linspace(0, len(load["times_s"]) - 1, most)).astype(int))
    taken = {name: [load[name][i] for i in every] for name in ("times_s", "wrench")}
    forces = [push | {"force": [push["force"][i] for i in every]} for push in load.get("forces", [])]
    return document | {"execution": document["execution"] | {"load": load | taken | {"forces": forces}}}


def between_knots(document: dict[str, Any], parts: int) -> dict[str, Any]:
    """Return a plan.json at every line of its load, and at the ends of so many parts of each piece between two."""
    load = document["execution"]["load"]
    lines, shares = np.array(load["times_s"], dtype=float), np.arange(parts) / parts
    pieces = [(i, s) for i, wide in enumerate(np.diff(lines)) for s in (shares if wide > 0 else [0.0])]
    first, share = (np.array(column) for column in zip(*pieces, strict=True)) if pieces else (np.zeros(0, int), [])

    def inside(rows: list[Any]) -> list[Any]:
        values = np.array(rows, dtype=float)
        along = values[first] + np.reshape(share, (-1, *[1] * (values.ndim - 1))) * np.diff(values, axis=0)[first]
        return [*along.tolist(), values[-1].tolist()]

    times = inside(lines.tolist())
    references = np.array(document["dz_r"], dtype=float).T
    forces = [push | {"force": inside(push["force"])} for push in load.get("forces", [])]
    finer = load | {"times_s": times, "wrench": inside(load["wrench"]), "forces": forces}
    return document | {
        "time_s": times, "wrench": finer["wrench"], "execution": document["execution"] | {"load": finer},
        "dz_r": np.transpose([np.interp(times, document["time_s"], column) for column in references]).tolist(),
    }  # fmt: skip


def load_at(document: dict[str, Any], knot: int) -> Load:
    """Return the load of a knot: its wrench, and the forces of it whose points go with the object."""
    wrench, stated = np.array(document["wrench"][knot], dtype=float), document["execution"]["load"]
    pushes = stated.get("forces", [])
    if not pushes:
        return Load(wrench)
    lines = [i for i, time in enumerate(stated["times_s"]) if time == document["time_s"][knot]]
    line = min(lines, key=lambda i: float(np.abs(np.array(stated["wrench"][i]) - wrench).max()))  # of a jump's two
    return Load(wrench, np.array([p["at_m"] for p in pushes]), np.array([p["force"][line] for p in pushes]))


Applied = tuple[Array, Load]
"""References and load."""


def followed(equilibrium: Equilibrium, state: State, start: Applied, end: Applied, halvings: int) -> State:
    """Return the state after references and load have gone straight from start to end."""
    try:
        found = equilibrium.settle(solved(equilibrium, state, *end), state)
    except NotReachedError:
        if not halvings:
            raise
        middle = (start[0] + end[0]) / 2, start[1].toward(end[1], 0.5)
        state = followed(equilibrium, state, start, middle, halvings - 1)
        return followed(equilibrium, state, middle, end, halvings - 1)
    if name := equilibrium.off_its_face(found):
        raise OffItsFaceError(f"contact {name} leaves its face")
    return found


class OffItsFaceError(NotReachedError):
    """A contact runs over an edge: nothing that smaller steps could change."""


def solved(equilibrium: Equilibrium, state: State, dz_r: Array, load: Load) -> Array:
    """Return the unknowns (n,) of the equilibrium that Newton's method finds from a state.

    The derivatives are kept as long as each step is a fifth of the one before it.
    """
    n_l, n_q = equilibrium.n_l, equilibrium.n_q
    size = np.concatenate([np.ones(n_l), np.full(n_q, 1e-2), np.full(3, 1e-3), np.full(3, 1e-2)])
    x, slopes, before = equilibrium.unknowns(state), None, np.inf
    for _ in range(ITERATIONS):
        if slopes is None:
            slopes = differences(equilibrium, x, size, state, dz_r, load)
        out = equilibrium.residual(x[None], state, dz_r, load)[0]
        rows = 1 / np.maximum(np.abs(slopes).max(axis=1), 1e-12)
        try:
            step = -np.linalg.solve(rows[:, None] * slopes, rows * out)
        except np.linalg.LinAlgError:
            raise NotReachedError("the equations are singular") from None
        x, moved = x + step * size, np.abs(step * size)[n_l:]
        if np.delete(moved, np.s_[n_q : n_q + 3]).max() > LARGEST_TURN or moved[n_q : n_q + 3].max() > LARGEST_SHIFT:
            raise NotReachedError("a small change moves hand or object far")
        largest = float(np.abs(step).max())
        if largest < 1e-9 * max(1.0, float(np.abs(x[:n_l]).max())):
            return x
        slopes, before = (slopes if largest < before / 5 else None), largest
    raise NotReachedError("no equilibrium was found nearby")


def differences(equilibrium: Equilibrium, x: Array, size: Array, state: State, dz_r: Array, load: Load) -> Array:
    """Return what the residual changes (n, n) with each unknown, in units of what is a small change (n,) of it.

    All unknowns are moved at once, each in a copy of the state: by 1e-4 of its size to either side.
    """
    h = np.diag(1e-4 * size)
    seen = equilibrium.residual(np.vstack([x + h, x - h]), state, dz_r, load)
    return np.asarray((seen[: len(x)] - seen[len(x) :]).T / 2e-4)


def _told(document: dict[str, Any], equilibrium: Equilibrium, reached: list[State], ended: str | None) -> Executed:
    forces = np.array([state.forces for state in reached]).reshape(len(reached), equilibrium.n_l)
    du = [[*(s.p - equilibrium.p_0), *Rotation.from_matrix(s.R).as_rotvec()] for s in reached]
    each = zip(equilibrium.contacts, equilibrium.slices, strict=True)
    margins = [slip_margin(contact["kind"], contact["parameters"], forces[:, part]) for contact, part in each]
    return Executed(
        np.array(document["time_s"][: len(reached)]), forces, np.array([state.q for state in reached]), np.array(du),
        np.array([equilibrium.held(state)[1] for state in reached]), np.stack(margins, axis=1), ended,
    )  # fmt: skip


def slip_margin(kind: str, parameters: dict[str, float], force: Array) -> Array:
    """Return how far forces (K, rows) are from slipping, or from tipping, (K,) [N]."""
    n = force[:, 0]
    if kind == "frictionless":
        return n
    mu_t = mu = parameters["friction"]
    mu_o = parameters.get("cross_friction", mu_t)
    mu = min(mu_t, mu_o)
    used = (force[:, 1] / mu_t) ** 2 + (force[:, 2] / mu_o) ** 2
    if kind != "hard":
        used = used + (force[:, 3] / parameters["spin_friction_m"]) ** 2
    margin = mu * (n - np.sqrt(used))
    if kind == "patch":
        margin = np.minimum(margin, n - np.hypot(force[:, 4], force[:, 5]) / parameters["patch_radius_m"])
    return np.where(n < 0, np.minimum(margin, n), margin)
