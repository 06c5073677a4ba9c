"""A no proven in exact arithmetic: a file with the grasp's matrices, the task's numbers and one multiplier a limit.

What is proven is a statement about the linear model of the start posture: no references within the box of the file keep
all of its limits at all of its knots. The sum of the limits' values, each times its multiplier, is no less than 0 for
references that keep them; in the box it is less. Whoever adds it up in fractions (`check_proof.py`) believes neither a
solver nor the rounding of this program.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.variable_bounds import farthest
from synergrip.documents.judging import expected
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.explain.exact.bare_limits import Cone
from synergrip.explain.exact.check_proof import checked
from synergrip.explain.exact.weighed_limits import Weighed, stated, tracked, weighed
from synergrip.linalg import Array
from synergrip.planning.outcome import Infeasible
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.tasks.scaling import grips
from synergrip.values import Value

FORMAT = "proof of infeasibility, 1"
CLAIM = (
    "no references dz_r with |dz_r| <= box keep all of these limits at these knots, in the linear model: "
    "lambda = lambda_0 + dlambda, C dlambda = J S dz_r - G' u, G dlambda = -(wrench - w_0), "
    "C = C_s + J (C_q + S C_z S') J'; lambda_0 null: the reaction to w_0"
)
NEGLIGIBLE = (1e-2, 1e-4, 0.0)
"""Share of the largest multiplier up to which others are left out; if no proof comes of it, less."""
OF_RANK = "no exact proof: this no is one of rank, and rank is a matter of tolerance"
OF_FREE = "no exact proof: the contacts leave the object free to move, and which way is a matter of tolerance"


@made_by("exact_proof(answer)")
@dataclass(frozen=True, eq=False, repr=False)
class ExactProof(Value):
    """A proof that no references within a box keep all limits, as numbers that anybody can add up.

    Example:
        >>> len(exact_proof(refused).document()["problem"]["box"])  # of an `Infeasible`
        4
    """

    problem: dict[str, Any]
    """What it is about, in plain numbers: matrices, loads, limits as cones of quantities, the box."""
    multipliers: list[Any]
    """[index of the limit, knot, one number for each row of its cone]."""
    sum: Fraction
    """What the limits, each times its multiplier, add up to at most, worked out from the document: below 0."""

    def document(self) -> dict[str, Any]:
        """Return what `check_proof.py` reads."""
        return marked(self.problem, self.multipliers)

    @property
    def of(self) -> str:
        """SHA-256 of the problem."""
        return _mark(self.problem)


@made_by("exact_proof(answer)")
@dataclass(frozen=True)
class NoExactProof:
    """Why there is none.

    Example:
        >>> unheld = load_problem("pinch-hard")
        >>> exact_proof(plan(unheld.grasp, unheld.task)).why
        'no exact proof: this no is one of rank, and rank is a matter of tolerance'
    """

    why: str


@naming_arguments
def exact_proof(no: Infeasible) -> ExactProof | NoExactProof:
    """Return a proof in exact arithmetic of what `plan` said, or why there is none.

    Args:
        no: what `plan` said.

    Returns:
        the proof, or a `NoExactProof`.

    Raises:
        InputError: no `Infeasible`.

    Example:
        >>> exact_proof(refused).sum < 0
        True
    """
    expected("no", no, Infeasible, "plan(grasp, task)")
    timed = no.task
    if no.stage != "magnitude":
        return NoExactProof(OF_RANK)
    posed = Asked.of(no.grasp, timed if no.asked is None else no.asked, timed).posed(no.analysis)
    if posed is None:
        return NoExactProof("no exact proof: the start posture has no program")
    if not posed.analysis.response.restrained:  # the equations of the document have no single answer
        return NoExactProof(OF_FREE)
    return _proven(posed)


def _proven(posed: Posed) -> ExactProof | NoExactProof:
    limits = posed.timed.all_limits
    at_knots = replace(posed.formulation, intersample=None, allowed=None)
    found = ask(Question(at_knots, limits, LeastEffort()), SOLVERS["clarabel"], grips(at_knots))
    if not found.decision.infeasible or found.decision.certificate.y is None:
        aside = "" if posed.formulation.allowed is None else "without what is allowed for, "
        return NoExactProof(f"no exact proof: {aside}of the knots alone, at the start posture, nothing is proven")
    formulation, program, y = found.question.formulation, found.decision.program, found.decision.certificate.y
    try:
        cones = stated(limits, formulation)
    except ValueError as why:
        return NoExactProof(f"no exact proof: {why}")
    value = Fraction(0)
    for share in NEGLIGIBLE:
        kept = weighed(cones, _rays(program, y, share))
        kept += tracked(formulation, kept)
        problem, multipliers = _problem(formulation, program, [cone for cone, _ in kept]), multipliers_of(kept)
        value = rechecked(marked(problem, multipliers))
        if value < 0:
            return ExactProof(problem, multipliers, value)
    return NoExactProof(f"no exact proof: in the box the limits add up to {float(value):.3g}, which is not below 0")


def _rays(program: Program, y: Array, share: float) -> list[Array]:
    """Return the multipliers (knots, items, rows) of each block, without cones that have next to none."""
    found, least = [], share * float(np.abs(y).max())
    for block, rows in program.slices():
        each = y[rows].reshape(block.knots, len(block.items), block.dim)
        found.append(np.where(np.abs(each).max(axis=2, keepdims=True) > least, each, 0.0))
    return found


def multipliers_of(limits: Weighed) -> list[Any]:
    """Return the multipliers of a document, each with its limit and its knot."""
    return [
        [i, cone.first_knot + k, row.tolist()]
        for i, (cone, rows) in enumerate(limits) for k, row in enumerate(rows) if np.any(row)
    ]  # fmt: skip


def rechecked(document: dict[str, Any]) -> Fraction:
    """Return the sum of a document, with every number as it would be read from its file."""
    text = json.dumps(document, allow_nan=False)
    return checked(json.loads(text, parse_float=lambda each: Fraction(float(each))))


def _problem(formulation: Formulation, program: Program, cones: Sequence[Cone]) -> dict[str, Any]:
    grasp = formulation.response.grasp
    matrices = {name: getattr(grasp, name).tolist() for name in ("G", "J", "S", "C_s", "C_q", "C_z")}
    return {
        "claim": CLAIM, "contacts": [[each.name, list(each.kind.components)] for each in grasp.contacts],
        "joints": list(grasp.joints), "synergies": list(grasp.synergies), **matrices,
        "lambda_0": None if grasp.lambda_0 is None else grasp.lambda_0.tolist(), "w_0": grasp.w_0.tolist(),
        "time_s": formulation.times.tolist(), "wrench": formulation.wrench.tolist(),
        "limits": [cone.document() for cone in cones], "box": _box(formulation, program).tolist(),
    }  # fmt: skip


def _box(formulation: Formulation, program: Program) -> Array:
    """Return (n_z,) what no reference of a plan exceeds: what the limits imply, or what the program takes for all."""
    bounds = program.variable_bounds.reshape(formulation.knots, formulation.n_v)
    alpha, beta, gamma = (
        (bounds @ np.abs(part.matrix).T + np.abs(part.constant)).max(axis=0)
        for part in (formulation.alpha, formulation.beta, formulation.gamma)
    )
    if not formulation.frees_gamma:
        gamma = np.full(len(gamma), farthest(formulation) * formulation.units.reference)
    found = np.abs(formulation.coordinates.inverse) @ np.concatenate([alpha, beta, gamma])
    return np.array([_rounded_up(each) for each in found])


def _rounded_up(value: float) -> float:
    """Return a number of two digits that is no less."""
    if not value > 0:
        return 0.0
    power = 10.0 ** np.floor(np.log10(value) - 1)
    return float(f"{np.ceil(value / power * (1 + 1e-12)) * power:.2g}")


def _mark(part: object) -> str:
    return hashlib.sha256(json.dumps(part, sort_keys=True).encode()).hexdigest()


def marked(problem: dict[str, Any], multipliers: list[Any]) -> dict[str, Any]:
    """Return the document, with the marks by which the checker sees that it is as it was written."""
    marks = [_mark(problem), _mark(multipliers)]
    return {"synergrip": FORMAT, "problem": problem, "multipliers": multipliers, "sha256": marks}
