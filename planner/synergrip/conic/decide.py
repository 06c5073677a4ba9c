"""From a program to a verified answer: solve, verify, try again differently, and admit it when nothing verifies."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from synergrip.conic.certificate import TIGHT, Certificate, judge_infeasible, judge_optimal, judge_unbounded
from synergrip.conic.program import Program
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.log import LOG
from synergrip.values import Value

Solver = Callable[[Program, Settings], Solution]

ATTEMPTS = (
    Settings(),
    Settings(tolerance=1e-8, structured=False),
    Settings(equilibrate=True, step=0.9, structured=False),
    Settings(equilibrate=True, regularisation=1e-10, structured=False),
    Settings(tolerance=1e-8, regularisation=1e-12, step=0.9, max_iterations=500, structured=False),
)
"""The retry chain. The first nearly always settles it: programs come normalised, equilibration does more harm."""
ALONG = (Settings(tolerance=1e-8), Settings(structured=False), *ATTEMPTS[2:])
"""The same around a path, where what is solved for to more digits than a promise is kept to is solved for in vain."""


@dataclass(frozen=True, eq=False, repr=False)
class Decision(Value):
    """A solver's last claim with its certificate; the verdict is the certificate's."""

    goal: str
    """Name of the goal."""
    program: Program
    solution: Solution
    certificate: Certificate
    attempts: int
    """How often solvers were run for it, with all settings, units and slacks that were tried."""
    seconds: float
    """In the solver, all attempts together."""

    @property
    def optimal(self) -> bool:
        """True when an optimum was found and verified."""
        return self.certificate.verified and self.certificate.kind == "optimal"

    @property
    def acceptable(self) -> bool:
        """True when a plan was found that holds and is nearly the best, even if that it is the best did not verify."""
        return self.certificate.acceptable

    @property
    def unbounded(self) -> bool:
        """True when it was found and verified that nothing bounds the goal."""
        return self.certificate.verified and self.certificate.kind == "unbounded"

    @property
    def infeasible(self) -> bool:
        """True when infeasibility was found and verified."""
        return self.certificate.verified and self.certificate.kind == "infeasible"


def decide(
    goal: str, program: Program, solver: Solver, violation: float = TIGHT, attempts: Sequence[Settings] = ATTEMPTS
) -> Decision:
    """Solve a program until a claim verifies sharply; else return the best claim of the retry chain.

    Sharp is a claim that violates no cone by more than `violation`. The best is the verified one with the smallest
    violation. When none verifies, neither does the decision; it is then, if there is one, the claim that keeps every
    row and has the smallest gap. What cannot end otherwise than an attempt before it is not tried,
    nor is anything once rounding hides what would be better.
    """
    best, runs, seconds = None, 0, 0.0
    closest: dict[tuple[object, ...], float] = {}
    for attempt, settings in enumerate(attempts, start=1):
        alike = (settings.equilibrate, settings.regularisation, settings.step, settings.max_iterations)
        if settings.tolerance < closest.get(alike, 0.0):
            continue
        solution = solver(program, settings)
        closest[alike] = solution.closest
        runs, seconds = runs + solution.runs, seconds + solution.seconds
        decision = Decision(goal, program, solution, judge(program, solution), runs, seconds)
        LOG.debug(
            "%s, attempt %d of %d: %s says '%s' after %d iterations; %s %s", goal, attempt, len(attempts),
            solution.solver, solution.status, solution.iterations, decision.certificate.kind,
            "verified" if decision.certificate.verified else "not verified",
        )  # fmt: skip
        if best is None or rank(decision) < rank(best):
            best = decision
        if decision.certificate.tight(violation):
            return decision
        if decision.certificate.rounded:
            break
    if best is None:
        raise ValueError("the retry chain is empty")
    return replace(best, attempts=runs, seconds=seconds)


def rank(decision: Decision) -> tuple[int, float]:
    """Order decisions: verified ones first, by violation; then those that hold, by gap."""
    return rank_of(decision.certificate)


def rank_of(certificate: Certificate) -> tuple[int, float]:
    """Order certificates in the same way."""
    if certificate.verified:
        return 0, certificate.primal_residual
    return (1, certificate.gap) if certificate.acceptable else (2, certificate.primal_residual)


def judge(program: Program, solution: Solution) -> Certificate:
    """Judge a claim. A solver that claims nothing is heard on both counts."""
    if solution.claim is Claim.UNBOUNDED:
        return judge_unbounded(program, solution.x)
    if solution.claim is not Claim.INFEASIBLE:
        optimal = judge_optimal(program, solution.x, solution.z)
        if optimal.verified or solution.claim is Claim.OPTIMAL:
            return optimal
    return judge_infeasible(program, solution.z)
