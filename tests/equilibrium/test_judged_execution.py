"""Variations of problems, planned and executed twice; `python tests/judged_execution.py` judges more of them."""

from __future__ import annotations

import pytest
from judged_execution import judged, on_hands


@pytest.mark.parametrize("seed", [4, 66])
def test_plans_keep_what_they_promise(seed: int) -> None:
    """A move of 2.5 mm and 3 degrees by all joints of the Barrett hand, and a hold by its synergies."""
    problems = on_hands()
    result = judged(problems[seed % len(problems)], seed, "rolling")
    assert result.found is not None, result
    assert result.found.same, result
    assert result.found.keeps(result.asked), result
