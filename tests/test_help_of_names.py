"""The help of every public name: each argument and an example, which prints what it says."""

from __future__ import annotations

import doctest
import inspect
import re
from dataclasses import fields, is_dataclass

import pytest
from names_in_examples import around

import synergrip as sg

NAMES = [name for name in sg.__all__ if name != "__version__"]
MADE_BY_OTHERS = {
    "Hand", "Grasp", "Analysis", "GraspStack", "Analyses", "Execution", "Program", "Certificate", "TimedTask",
    "Problem", "Plan", "Infeasible", "Unknown", "ExactProof", "NoExactProof", "Simulation", "Contact",
    "Explanation", "Repair", "When",
    "MissingSynergies", "SynergiesNeeded", "Margins", "Measure", "DirectNumber", "GraspProperties",
    "Disturbances", "WithstoodAlong", "Withstood", "WrenchSpaceQuality",
    "Sensitivities", "Sensitivity", "FastestTiming", "InCase", "ManyPlans", "ManyMargins", "PlacedObject",
}  # fmt: skip
"""Values that functions return: their fields are told where they stand, and no arguments of the user's."""


@pytest.mark.parametrize("name", NAMES)
def test_a_name_has_an_example_that_prints_what_it_says(name: str) -> None:
    text = inspect.getdoc(getattr(sg, name)) or ""
    assert re.search(r"^Example:$", text, re.MULTILINE)
    example = doctest.DocTestParser().get_doctest(text, dict(around()), name, None, None)
    assert doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(example).failed == 0


@pytest.mark.parametrize("name", sorted(set(NAMES) - MADE_BY_OTHERS))
def test_the_help_tells_of_each_argument(name: str) -> None:
    made = getattr(sg, name)
    if inspect.isfunction(made):
        arguments = list(inspect.signature(made).parameters)
    else:
        arguments = [each.name for each in fields(made) if each.init] if is_dataclass(made) else []
    text = inspect.getdoc(made) or ""
    told = [each for each in arguments if re.search(rf"^ +\**{each}: ", text, re.MULTILINE)]
    assert told == arguments
    assert "Raises:" in text or not arguments
