"""What was solved and what was checked of it: a line each, and all of it for those who ask for details."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from synergrip.conic.decide import Decision
from synergrip.conic.solution import Claim
from synergrip.documents.words import listed
from synergrip.planning.in_cases import ALL_CASES
from synergrip.planning.outcome import BETWEEN, Infeasible, Plan
from synergrip.planning.verified import EQUILIBRIUM
from synergrip.problems.in_short import many
from synergrip.reports.text.tables import table, wrapped

ABOUT = "it is about the linear model at the start posture"


def solved_lines(decisions: Sequence[Decision], *, details: bool) -> Iterator[str]:
    """Yield how many programs were solved, how large they are and how long it took; with details each of them."""
    if not decisions:
        return
    solvers = " and ".join(dict.fromkeys(decision.solution.solver for decision in decisions))
    variables = many(max(len(decision.program.q) for decision in decisions), "variable")
    size = f"{len(decisions)} programs of up to {variables}" if len(decisions) > 1 else f"1 program of {variables}"
    tries = sum(decision.attempts for decision in decisions)
    more = f", {tries} attempts" if tries > len(decisions) else ""
    # a program that a solver came to no end of says nothing of the answer: which it is, is told with the details
    short = [each for each in decisions if each.solution.claim not in (Claim.OPTIMAL, Claim.NOTHING)]
    claims = ", ".join(dict.fromkeys(f"{each.goal} {each.solution.claim}" for each in short))
    nothing = sum(each.solution.claim is Claim.NOTHING for each in decisions)
    if nothing == len(decisions):
        claims = "no answer of the solver"
    elif nothing:
        named = "" if details else "; -v names them"
        claims = f"{claims or 'optimal'} ({nothing} of them without an answer of the solver{named})"
    claims = claims or "optimal"
    took = f"{1e3 * sum(decision.seconds for decision in decisions):.0f} ms{more}"
    yield from wrapped("solve    ", f"{size} by {solvers} in {took}: {claims}")
    if details:
        head = ("goal", "variables", "cones", "claim", "iterations", "attempts", "time")
        yield table(head, [_row(decision) for decision in decisions], right=(1, 2, 4, 5, 6))


def _row(decision: Decision) -> tuple[str, ...]:
    solution = decision.solution
    return (
        decision.goal, str(len(decision.program.q)), str(_cones(decision)), str(solution.claim),
        str(solution.iterations), str(decision.attempts), f"{1e3 * decision.seconds:.1f} ms",
    )  # fmt: skip


def _cones(decision: Decision) -> int:
    return sum(block.cones for block in decision.program.blocks)


def checked_lines(plan: Plan, *, details: bool) -> Iterator[str]:
    """Yield that all checks of a plan passed; with details each of them."""
    missing = list(dict.fromkeys(decision.goal for decision in plan.decisions if not decision.optimal))
    verified = f"not of {listed(missing)}" if missing else "✓"  # then a note says what that means
    there = [check for check in plan.checks if plan.executed is not None and check.name.startswith(BETWEEN)]
    cases = [check for check in plan.checks if check.name.startswith(ALL_CASES)]
    balance = [check for check in plan.checks if check.name == EQUILIBRIUM]
    others = len(plan.checks) - len(there) - len(cases) - len(balance)
    parts = [f"certificate {verified}", *(f"{check.name} {check.error:.0e} ✓" for check in balance)]
    parts += [f"{others} more ✓"] * bool(others) + [f"{len(there)} between the knots ✓"] * bool(there)
    parts += [f"{len(cases)} in all cases ✓"] * bool(cases)
    yield from wrapped("check    ", " · ".join(parts))
    if details:
        certificates = [decision.certificate for decision in plan.decisions]
        rows = [
            (f"certificate: {name}", f"{max(getattr(each, key) for each in certificates):.1e}", "")
            for name, key in (("cones", "primal_residual"), ("gap", "gap"))
        ]
        rows += [(check.name, f"{check.error:.1e}", f"{check.tolerance:.0e}") for check in plan.checks]
        yield table(("check", "error", "tolerance"), rows)


def proof_lines(outcome: Infeasible, *, details: bool) -> Iterator[str]:
    """Yield that the proof was re-checked, and on a hand what it is about; with details how well it holds."""
    moves = outcome.grasp.held is not None
    source = "the grasp's matrices" if outcome.refusal is not None else "the program's own data"
    yield from wrapped("check    ", f"proof re-checked; {ABOUT}" if moves else f"proof re-checked from {source}")
    if details:
        c = outcome.certificate
        told = f"from {source}: ‖Aᵀy‖ {c.primal_residual:.0e}, bᵀy + |Aᵀy|·box = {c.gap:.3g} < 0, y in the dual cone"
        if outcome.refusal is not None:
            told = f"from {source} (leak {c.primal_residual:.0e})"
        yield from wrapped("         ", told + "; contacts, G and J stay as they are there" * moves)
