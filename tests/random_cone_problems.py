"""Random cone programs with an optimum, and Clarabel's answers to them; random grasps of one form."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from random_tasks import LEVER, _contacts

from synergrip.batch.cone_problems import ConeProblems, groups_of
from synergrip.conic.certificate import Certificate, judge_infeasible, judge_optimal
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.conic.solution import Settings
from synergrip.conic.solvers import clarabel_
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, block_diagonal, frozen


def random_problems(count: int, unknowns: int, sizes: Sequence[int], *, quadratic: bool, seed: int) -> ConeProblems:
    """Programs made around a point and multipliers, so that each has an optimum; about half of the cones are active."""
    rng, order = np.random.default_rng(seed), tuple(sorted(sizes))
    m = sum(order)
    A, x = rng.normal(size=(count, m, unknowns)), rng.normal(size=(count, unknowns))
    s, z = rng.normal(size=(2, count, m))
    for group in groups_of(order):
        for values in (s, z):
            part = values[:, group.rows].reshape(count, group.cones, group.size)
            part[..., 0] = np.linalg.norm(part[..., 1:], axis=-1) + rng.uniform(0.0, 1.0, part.shape[:2])
            values[:, group.rows] = part.reshape(count, -1)
    F = rng.normal(size=(count, unknowns, unknowns))
    P = F.mT @ F if quadratic else np.zeros((1, unknowns, unknowns))
    q = -(A.mT @ z[:, :, None])[:, :, 0] - (P @ x[:, :, None])[:, :, 0]
    return ConeProblems(P, q, A, (A @ x[:, :, None])[:, :, 0] + s, order)


def program_of(problems: ConeProblems, place: int, bounds: Array) -> Program:
    """One of the programs as `conic` has it."""
    from scipy import sparse

    P, q, A = (each[place if len(each) > 1 else 0] for each in (problems.P, problems.q, problems.A))
    blocks = []
    for group in problems.groups:
        kind = Kind.NONNEGATIVE if group.size == 1 else Kind.SECOND_ORDER
        items = tuple(Item(str(i)) for i in range(group.cones))
        blocks.append(Block("random", kind, group.size, items, 0, 1))
    return Program(
        sparse.csc_matrix(P), frozen(q), sparse.csc_matrix(A), frozen(problems.b[place]), tuple(blocks), 1, len(q),
        frozen(bounds),
    )  # fmt: skip


def by_clarabel(problems: ConeProblems, tolerance: float) -> list[Array]:
    """Return the unknowns of each by Clarabel."""
    bounds = np.full(problems.q.shape[-1], np.inf)
    settings = Settings(tolerance=tolerance)
    return [clarabel_.solve(program_of(problems, i, bounds), settings).x for i in range(len(problems))]


def values(problems: ConeProblems, x: Array) -> Array:
    """Return the objectives (N,) at x (N, n)."""
    return np.asarray((x * ((problems.P @ x[:, :, None])[:, :, 0] / 2 + problems.q)).sum(axis=1))


def certificates(problems: ConeProblems, x: Array, z: Array, bounds: Array) -> list[Certificate]:
    """Return what `conic/certificate.py` says of each claim of an optimum."""
    return [judge_optimal(program_of(problems, i, bounds[i]), x[i], z[i]) for i in range(len(problems))]


def proofs(problems: ConeProblems, y: Array, bounds: Array) -> list[Certificate]:
    """Return what `conic/certificate.py` says of each proof."""
    return [judge_infeasible(program_of(problems, i, bounds[i]), y[i]) for i in range(len(problems))]


def grasp_like(rng: np.random.Generator, kinds: Sequence[str], n_z: int = 5) -> Grasp:
    """A grasp around a small object with fingers of three joints, contacts hard or soft as `kinds` say."""
    contacts = []
    for contact, kind in zip(_contacts(rng, len(kinds), {"hard": 1.0}), kinds, strict=True):
        spin = float(rng.uniform(0.002, 0.01))
        soft = SoftFinger(friction=contact.friction, spin_friction=spin)
        own = HardFinger(friction=contact.friction) if kind == "hard" else soft
        contacts.append(Contact(name=contact.name, kind=own, point=contact.point, frame=contact.frame))
    J = block_diagonal([_finger_of_three(rng, contact.n_rows) for contact in contacts])
    S = 0.5 * rng.normal(size=(J.shape[1], n_z))
    for first in range(0, J.shape[1], 3):  # the first two synergies close all fingers
        S[first, :2], S[first + 1, :2] = rng.uniform(0.5, 1.5, 2), rng.uniform(0.2, 0.8, 2)
    soft_rows = np.array([1e4 if name == "m" else 1.0 for c in contacts for name in c.kind.components])
    n_q = J.shape[1]
    return Grasp(
        title="", contacts=tuple(contacts), G=grasp_matrix(contacts), J=J, S=S,
        C_s=3e-4 * np.diag(soft_rows * rng.uniform(0.7, 1.4, len(soft_rows))), C_q=0.02 * np.eye(n_q),
        C_z=np.zeros((n_z, n_z)), joints=tuple(f"q{i}" for i in range(n_q)),
        synergies=tuple(f"z{i}" for i in range(n_z)),
    )  # fmt: skip


def _finger_of_three(rng: np.random.Generator, rows: int) -> Array:
    block = 0.25 * rng.normal(size=(rows, 3))
    block[0, :2] += [1.0, 0.6]
    block[1:3, 1] += 0.8 * rng.normal(size=2)
    block[1:3, 2] += rng.normal(size=2)
    block[:3] *= LEVER
    return np.asarray(block)


def random_wrenches(rng: np.random.Generator, count: int, size: float = 1.0) -> Array:
    """Loads (count, 6) of about `size` newtons, with moments that a small object has."""
    return size * np.hstack([rng.normal(size=(count, 3)), 0.005 * rng.normal(size=(count, 3))])
