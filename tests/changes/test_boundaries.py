"""Verdicts on both sides of the value from which there is a plan are certain to a millionth of it."""

from __future__ import annotations

import numpy as np
import pytest
from altered_numbers import DOWN, turned
from least_changes import LeastChanges
from too_much import altered

from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan

CLOSE = 1e-6
SAME = 1e-5
"""Relative difference to the value that the second model finds."""


@pytest.mark.parametrize("number", ["friction", "load", "torque"])
@pytest.mark.parametrize("seed", [0, 1])
def test_yes_and_no_meet(number: str, seed: int) -> None:
    rng = np.random.default_rng([17, seed])
    question = next(found for found in (altered(rng, number) for _ in range(30)) if found is not None)
    critical = LeastChanges(*question).factor(number)
    no, yes = 1.0, critical * (0.9 if number in DOWN else 1.1)
    assert isinstance(plan(*question), Infeasible)
    assert isinstance(plan(*turned(*question, number, yes)), Plan)
    while abs(yes / no - 1) > CLOSE:
        middle = float(np.sqrt(no * yes))
        outcome = plan(*turned(*question, number, middle))
        assert isinstance(outcome, Plan | Infeasible), f"{outcome.verdict} at a factor of {middle:.9g}"
        if isinstance(outcome, Plan):
            yes = middle
        else:
            assert outcome.certificate.verified
            no = middle
    assert yes == pytest.approx(critical, rel=SAME)
