"""What is only likely: places and normals of contacts and compliance, as random samples of the grasp."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np

from synergrip.conic.sampled import started
from synergrip.documents.judging import described, is_whole
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen
from synergrip.statics import Response, respond
from synergrip.tasks.arguments import TaskArguments, keep
from synergrip.tasks.shares import largest_share, samples_for
from synergrip.values import ByContent
from synergrip.vectors import rotation_matrices

if TYPE_CHECKING:
    from synergrip.equilibrium.setting import Setting

LOOKS = 3
"""How often fresh samples on a hand may be looked at; each time they are others."""
MOST_FRESH = 1000
"""Fresh samples in one look, at most."""
SAME = 1e-6
"""Entries of G that are the same [m]."""
LARGEST_SEED = 2**63
KEY = "Task.allow.scenarios"


@naming_arguments
@dataclass(frozen=True, eq=False, kw_only=True)
class Scenarios(ByContent):
    """Random errors of a grasp, of which a plan is to hold for a stated share.

    A plan of d numbers that keeps its limits in N samples, drawn at random, keeps them in all but a share epsilon of
    all others, with confidence 1 - beta, where ``sum over i < d of C(N, i) epsilon^i (1 - epsilon)^(N - i) <= beta``
    (Campi and Garatti, the scenario approach to convex programs). The references are the same in all of them.

    On a hand nothing is convex: samples other than those that a plan was made with are executed there, and of N of
    these k may miss a limit, by the same sum over ``i <= k`` (Clopper and Pearson, bounds of the binomial
    distribution). There may be `LOOKS` such looks, each with as much of beta.

    Args:
        position: largest distance of a contact on the object from where it is stated, evenly spread in that ball [m];
            on a hand in that disc of the surface, and the pad touches there.
        normal: largest tilt of its normal, evenly spread in that cone [rad].
        compliance: share by which contacts, joints and synergies may each be stiffer or softer, below 1.
        share: epsilon, of samples that may miss a limit, between 0 and 1.
        confidence: that no larger share does, between 0 and 1.
        seed: of the samples, a whole number from 0 to 2^63 - 1.

    Raises:
        InputError: no such numbers, or nothing that is random.

    Example:
        >>> Scenarios(position=1e-3, normal=np.radians(3)).count(4)
        257
    """

    position: float = 0.0
    normal: float = 0.0
    compliance: float = 0.0
    share: float = 0.05
    confidence: float = 0.999
    seed: int = 0

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("Scenarios")
        found = {each.name: judge.real(each.name, getattr(self, each.name), at_least=0) for each in fields(self)[:-1]}
        if found["normal"] >= np.pi / 2:
            judge.refuse("normal", f"expected radians, less than a right angle, got {found['normal']:g}")
        if found["compliance"] >= 1:
            judge.refuse("compliance", f"expected a share less than 1, got {found['compliance']:g}")
        for name in ("share", "confidence"):
            if not 0 < found[name] < 1 and not judge.issues:
                judge.refuse(name, f"expected a share between 0 and 1, got {found[name]:g}")
        if not is_whole(self.seed) or not 0 <= self.seed < LARGEST_SEED:
            judge.refuse("seed", f"expected a whole number from 0 to 2^63 - 1, got {described(self.seed)}")
        keep(self, judge, **found)
        if not (self.position or self.normal or self.compliance):
            raise InputError.at("Scenarios", "nothing is random; give position, normal or compliance")

    def count(self, unknowns: int) -> int:
        """Return the least number of samples for a plan of so many numbers."""
        return samples_for(unknowns - 1, self.share, 1 - self.confidence)

    @property
    def looks(self) -> int:
        """How often fresh samples on a hand may be looked at."""
        return LOOKS

    def fresh(self, missing: int = 0) -> int:
        """Return the least number of fresh samples on a hand of which so many may miss a limit, in one of the looks."""
        return samples_for(missing, self.share, (1 - self.confidence) / LOOKS)

    def share_at_most(self, missing: int, count: int) -> float:
        """Return the share of samples that miss, at most, where so many of a number of fresh ones on a hand do."""
        return largest_share(missing, count, (1 - self.confidence) / LOOKS)

    def on_hand(self, grasp: Grasp, part: int, number: int) -> Setting:
        """Return a sample of a grasp on a hand.

        Args:
            grasp: on a hand.
            part: of the seed: samples of different ones have nothing to do with each other.
            number: of the sample.

        Raises:
            OffTheFaceError: a contact would be beyond the edge of its face.
        """
        from synergrip.tasks.scenario_on_hand import Errors, sample_of

        rng = np.random.default_rng([self.seed, part, number])
        (across, size, around, tilt), factors = rng.random((4, grasp.n_c)), rng.uniform(-1, 1, 3)
        shifts = self.position * np.sqrt(size) * np.array([np.cos(2 * np.pi * across), np.sin(2 * np.pi * across)])
        axes = np.array([np.zeros(grasp.n_c), np.cos(2 * np.pi * around), np.sin(2 * np.pi * around)])
        turns = rotation_matrices((self.normal * np.sqrt(tilt) * axes).T)
        return sample_of(grasp, Errors(shifts.T, turns, tuple(1 + self.compliance * factors)))

    def drawn(self, grasp: Grasp, count: int, first: int = 0) -> tuple[Response, ...]:
        """Return the maps of so many samples of a grasp.

        Args:
            grasp: given as matrices, with the points and normals of its contacts.
            count: of samples.
            first: where in the seed they begin; others than those of a plan judge it.
        """
        return tuple(
            respond(self._sample(grasp, np.random.default_rng([self.seed, first + i])), grasp.w_0[None])
            for i in range(count)
        )

    def _sample(self, grasp: Grasp, rng: np.random.Generator) -> Grasp:
        contacts, J = [], np.array(grasp.J)
        for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
            turn = _tilt(rng, contact.frame, self.normal)
            shift = _direction(rng) * self.position * np.cbrt(rng.random())
            contacts.append(replace(contact, point=frozen(contact.point + shift), frame=frozen(turn @ contact.frame)))
            if rows.stop - rows.start >= 3:
                three = slice(rows.start, rows.start + 3)
                J[three] = contact.frame.T @ turn.T @ contact.frame @ J[three]
        soft = {name: getattr(grasp, name) * rng.uniform(1 - self.compliance, 1 + self.compliance)
                for name in ("C_s", "C_q", "C_z")}  # fmt: skip
        G = grasp_matrix(tuple(contacts)) if self.position or self.normal else grasp.G
        found = replace(grasp, contacts=tuple(contacts), G=G, J=frozen(J), lambda_0=None, **soft)
        if grasp.lambda_0 is None:
            return found
        return replace(found, lambda_0=started(respond(found), grasp.lambda_0))


def refuse_scenarios(grasp: Grasp, scenarios: Scenarios, *, between: bool) -> None:
    """Refuse scenarios of a grasp of which not enough is known.

    Raises:
        InputError: says what is missing.
    """
    if grasp.held is not None and (count := scenarios.fresh()) > MOST_FRESH:
        message = f"takes {count} samples on a hand that moves, more than the {MOST_FRESH} that are executed"
        raise InputError.at(f"{KEY}.share", f"{message}; give a larger share, or less confidence")
    if between and grasp.held is None:
        raise InputError.at(KEY, 'scenarios are kept at the knots; leave out between = "hold"')
    placed = np.allclose(grasp_matrix(grasp.contacts), grasp.G, rtol=0, atol=SAME)
    if (scenarios.position or scenarios.normal) and not placed:
        raise InputError.at(KEY, "G is not that of the stated points and normals; give those, or compliance alone")
    if scenarios.normal and any(_few(contact) for contact in grasp.contacts):
        raise InputError.at(f"{KEY}.normal", "a contact of which only the normal force is known cannot be tilted")


def _few(contact: Contact) -> bool:
    return contact.n_rows < 3


def _direction(rng: np.random.Generator) -> Array:
    found = rng.normal(size=3)
    return np.asarray(found / np.linalg.norm(found))


def _tilt(rng: np.random.Generator, frame: Array, most: float) -> Array:
    """Return a rotation (3, 3) about a random axis across the normal."""
    angle, size = rng.uniform(0, 2 * np.pi), most * np.sqrt(rng.random())
    return rotation_matrices(size * (frame @ [0.0, np.cos(angle), np.sin(angle)]))
