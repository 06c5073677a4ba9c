"""Who answers questions: a solver's name on the command line made into a function. A new solver is listed here."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import astuple, dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.conic.certificate import GAP_TOLERANCE, TIGHT, rounding_hides
from synergrip.conic.decide import ALONG, ATTEMPTS, Decision, decide, rank
from synergrip.conic.formulation import Units
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.relaxed import proving
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers import by_structure
from synergrip.documents.judging import described
from synergrip.errors import InputError, SynergripError, one_of
from synergrip.linalg import Array, largest_size
from synergrip.log import LOG
from synergrip.planning.worth import weighed
from synergrip.values import Value

Answerer = Callable[[Question, Program, Settings], Solution]


def directly(solve: Callable[[Program, Settings], Solution]) -> Answerer:
    """Return a file of `conic/solvers` as who answers: what it cannot refute is proven by the relaxed program."""
    proves = proving(solve)
    return lambda question, program, settings: proves(program, settings)


def _cvxpy(question: Question, program: Program, settings: Settings) -> Solution:
    """Answer by the second formulation; it writes down the start posture, and leaves what is around a path."""
    if question.formulation.along_path:
        return SOLVERS["clarabel"](question, program, settings)
    from synergrip.referee import judge as referee

    return referee.solve(question, program, settings)


SOLVERS: dict[str, Answerer] = {
    "clarabel": directly(by_structure.solve),
    "cvxpy": _cvxpy,
}
""""cvxpy" writes the question down by itself, independently of the program's rows. A new solver is a line here."""


def answerer(name: str | Answerer, key: str = "--solver") -> Answerer:
    """Return the solver of that name, or one that is a function already.

    Raises:
        InputError: none of that name, at the option or argument `key`; the names are listed.
    """
    if callable(name) and not isinstance(name, type):
        return _answering(name, key)
    if not isinstance(name, str) or name not in SOLVERS:
        raise InputError.at(key, one_of(name, SOLVERS))
    return SOLVERS[name]


def _answering(solve: Answerer, key: str) -> Answerer:
    """Return a user's function as a solver whose answers are looked at."""

    def answered(question: Question, program: Program, settings: Settings) -> Solution:
        try:
            found = solve(question, program, settings)
        except SynergripError:
            raise
        except Exception as error:
            raise InputError.at(key, f"the function raised {type(error).__name__}: {error}") from error
        if not isinstance(found, Solution):
            raise InputError.at(key, f"expected a Solution from the function, got {described(found)}")
        return found

    return answered


SMALL, NOTHING = 1e-2, 1e-12
"""Value of a goal, in the program's units, below which a gap that is small beside 1 need not be small beside the value;
and below which a sum of squares, which is never less than 0, is as good as 0. A force is the root of that."""
FINE = 1e-6
"""How closely forces are known when they are: to this share of the load, or of the largest of them."""
AGAIN = 3
"""How often a question is asked in other units, at most."""
APART = 3.0
"""Factor between two units that makes a difference."""


@dataclass(frozen=True, eq=False, repr=False)
class Answered(Value):
    """A question as it was finally asked, in units that suit its answer, and the answer."""

    question: Question
    decision: Decision

    @property
    def v(self) -> Array:
        """(T, n_v) unknowns."""
        return self.decision.program.unknowns(self.decision.solution.x)

    @property
    def largest_margin(self) -> float:
        """The largest margin [N], where that was the goal."""
        return float(self.decision.solution.x[-1]) * self.question.formulation.force_unit

    @cached_property
    def value(self) -> float:
        """Value of the goal, in the program's units; small squares are added up, so that no terms cancel."""
        value = self.decision.program.objective(self.decision.solution.x)
        if value > SMALL:
            return value
        cost = self.question.goal.objective(self.question.formulation)
        return value if cost.epigraph is not None else cost.squared(self.v) / self.question.worth

    @cached_property
    def small(self) -> bool:
        """True when the value is small beside 1: a margin never is, it is measured against the load."""
        if isinstance(self.question.goal, LargestMargin):
            return False
        value = self.value
        if value >= SMALL:
            return False
        scalar = self.question.goal.objective(self.question.formulation).epigraph is not None
        return value > (NOTHING**0.5 if scalar else NOTHING)  # a force, or a sum of squares

    @cached_property
    def coarse(self) -> bool:
        """True for an answer in a unit so far above all forces that its tolerances hide the forces."""
        formulation, found = self.question.formulation, self.decision.certificate
        if not self.decision.acceptable:
            return False
        of_value = isinstance(self.question.goal, LargestMargin)  # which is a force itself
        residuals = found.primal_residual + (found.dual_residual + found.gap if of_value else 0.0)
        share = residuals if found.verified else TIGHT
        error = share * formulation.force_unit
        if error <= FINE * formulation.load_size:
            return False
        largest = formulation.response.scale.largest_force(formulation.force.at(self.v))
        return bool(error > FINE * max(formulation.load_size, largest))

    @property
    def settled(self) -> bool:
        """True for a verified answer; when it is an optimum, for one that is neither small beside 1 nor coarse."""
        return self.decision.certificate.verified and not (self.decision.optimal and (self.small or self.coarse))

    @property
    def hidden(self) -> bool:
        """True where rounding hides in any units what is least of a goal that can be looked at less closely."""
        decision = self.decision
        doubt = decision.optimal and self.small and rounding_hides(decision.program, decision.solution.x, self.value)
        return self.question.goal.rescaled is not None and (decision.certificate.rounded or doubt)

    def with_all(self, *others: Decision) -> Answered:
        """Return it with what other attempts at the same cost, too, told in its decision."""
        if not others:
            return self
        decision = self.decision
        attempts = decision.attempts + sum(each.attempts for each in others)
        seconds = decision.seconds + sum(each.seconds for each in others)
        return replace(self, decision=replace(decision, attempts=attempts, seconds=seconds))

    @property
    def place(self) -> tuple[bool, int, float]:
        """Its place among answers to the same question: settled ones first, then by violation, then by gap."""
        decision = self.decision
        if not self.settled and decision.acceptable and self.value > 0:
            return True, 1, decision.certificate.gap * max(1.0, 1.0 / self.value)
        return not self.settled, *rank(decision)


def ask(question: Question, solver: Answerer, sizes: Iterable[float] = ()) -> Answered:
    """Build the program of a question, have it solved and verified; asked again in other units when that is needed.

    Args:
        question: in units of what the task asks for.
        solver: who answers.
        sizes: [N] forces in whose units it is asked, too, when those of an answer do not help.
    """
    question = weighed(question)
    best = found = _decided(question, solver)
    if best.settled:
        return best
    tried, left = [best], list(sizes)
    for _ in range(AGAIN + len(left)):
        if best.settled or best.hidden:
            break
        other = _in_its_units(found) or (_in_units_of(question, left.pop(0)) if left else None)
        if other is None:
            break
        LOG.debug("%s: asked again in the units %s", question.goal.name, other.formulation.units)
        found = _decided(other, solver)
        tried.append(found)
        best = min(best, found, key=lambda each: each.place)
    chosen = best.with_all(*(each.decision for each in tried if each is not best))
    return chosen if best.settled else _beside_its_value(_less_closely(chosen, solver))


def _decided(question: Question, solver: Answerer) -> Answered:
    program = question.program()
    attempts = ALONG if question.formulation.along_path else ATTEMPTS
    name, tight = question.goal.name, question.violation
    return Answered(question, decide(name, program, lambda *asked: solver(question, *asked), tight, attempts))


def _in_its_units(found: Answered) -> Question | None:
    """Return the question in units of the forces, references and motions of an answer; None when that is no change."""
    question, v = found.question, found.v
    if found.decision.solution.claim not in (Claim.OPTIMAL, Claim.NOTHING) or not np.all(np.isfinite(v)):
        return None
    formulation, old = question.formulation, question.formulation.units
    if formulation.unreduced is None:
        motion = formulation.beta.at(v) - formulation.beta.constant
        force = formulation.response.scale.largest_force(formulation.force.at(v))
        sizes = (force, largest_size(formulation.reference.at(v)), largest_size(motion))
        units = Units(*(size if 0 < size < np.inf else was for size, was in zip(sizes, astuple(old), strict=True)))
        formulation, v = (
            formulation.in_units(units),
            v * formulation.column_units(old) / formulation.column_units(units),
        )
    value = question.goal.objective(formulation).squared(v)
    worth = value if 0 < value < np.inf else question.worth
    new = (*astuple(formulation.units), worth)
    ratios = np.array(new) / np.array((*astuple(old), question.worth))
    if np.all((ratios < APART) & (ratios > 1 / APART)):
        return None
    return replace(question, formulation=formulation, worth=worth)


def _in_units_of(question: Question, force: float) -> Question | None:
    """Return the question in another unit of force [N]; None when earlier goals have determined a part of the plan."""
    formulation = question.formulation
    if formulation.unreduced is not None:
        return None
    return replace(question, formulation=formulation.in_units(replace(formulation.units, force=force)))


def _less_closely(best: Answered, solver: Answerer) -> Answered:
    """Return the goal looked at less closely, when nothing verifies and there is such a way."""
    goal = best.question.goal
    if best.decision.certificate.verified or goal.rescaled is None:
        return best
    second = _decided(replace(best.question, goal=goal.rescaled), solver)
    chosen, other = (second, best) if second.decision.optimal else (best, second)
    return chosen.with_all(other.decision)


def _beside_its_value(best: Answered) -> Answered:
    """Return the answer judged by its gap relative to a small value: what is then no optimum is not called one."""
    if best.coarse:
        certificate = replace(best.decision.certificate, verified=False, gap=np.inf)
        return replace(best, decision=replace(best.decision, certificate=certificate))
    if not best.decision.optimal or not best.small:
        return best
    certificate = best.decision.certificate
    judged = replace(certificate, verified=certificate.gap <= GAP_TOLERANCE * best.value)
    return replace(best, decision=replace(best.decision, certificate=judged))
