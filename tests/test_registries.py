"""Every limit and goal of the registries is whole: second formulation, a test that it bites, documentation, a name."""

from __future__ import annotations

import importlib
import pkgutil
import re
from pathlib import Path
from types import ModuleType

import pytest
from planning.test_goal_order import ORDERS, WEIGHTS
from planning.test_limits_bite import BITES, BITTEN_ELSEWHERE
from random_formulations import LIMITS as RANDOM
from random_formulations import random_formulation

import synergrip
import synergrip.conic.goals
import synergrip.conic.limits
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.registry import LIMITS
from synergrip.referee import formulas

DOCUMENTED = (Path(__file__).parent.parent / "docs" / "problem-file.md").read_text(encoding="utf-8")


def section(title: str) -> str:
    """Return a section of the description of the problem file."""
    return DOCUMENTED.split(f"\n## [{title}]", 1)[1].split("\n## ", 1)[0]


def in_files(package: ModuleType, kind: type) -> list[object]:
    """Return everything of a kind that the modules of a package hold at their top, by itself or by name."""
    names = [each.name for each in pkgutil.iter_modules(package.__path__) if each.name != "registry"]
    modules = [importlib.import_module(f"{package.__name__}.{name}") for name in names]
    held = [value for module in modules for value in vars(module).values()]
    inside = [each for value in held if isinstance(value, dict) for each in value.values()]
    return [value for value in (*held, *inside) if isinstance(value, kind)]


@pytest.mark.parametrize("key", LIMITS, ids=lambda key: key.name)
def test_a_limit_is_whole(key: FileKey) -> None:
    grasp = random_formulation(0)[1].response.grasp
    kinds = {type(make(grasp)) for make in RANDOM.values()}
    there = {
        "a formula in referee/formulas.py": key.kind in formulas.LIMITS,
        "a line in tests/planning/test_limits_bite.py": key.name in {*BITES, *BITTEN_ELSEWHERE},
        "a row in docs/problem-file.md": f"| `{key.name}` |" in section("limits"),
        "its name in synergrip/__init__.py": getattr(synergrip, key.kind.__name__, None) is key.kind,
        "a line in tests/random_formulations.py": key.kind in kinds or key.kind.__mro__[1] in kinds,
        "an Example: in its docstring": "Example:" in (key.kind.__doc__ or ""),
    }
    assert not [what for what, is_there in there.items() if not is_there]


@pytest.mark.parametrize("name", GOALS)
def test_a_goal_is_whole(name: str) -> None:
    goal = GOALS[name]
    there = {
        "a formula in referee/formulas.py": type(goal) in formulas.GOALS,
        "an order in tests/planning/test_goal_order.py": name in {x for order in ORDERS for x in (*order, *WEIGHTS)},
        "a word in docs/problem-file.md": bool(re.search(rf'[`"]{name}[`"]', section("goal"))),
        "its name in synergrip/__init__.py": getattr(synergrip, type(goal).__name__, None) is type(goal),
    }
    assert not [what for what, is_there in there.items() if not is_there]


def test_nothing_that_a_file_offers_is_left_out_of_its_registry() -> None:
    keys = {key.name for key in in_files(synergrip.conic.limits, FileKey) if isinstance(key, FileKey)}
    assert keys == {key.name for key in LIMITS}
    assert len(LIMITS) == len({key.name for key in LIMITS})
    assert set(in_files(synergrip.conic.goals, Goal)) == set(GOALS.values())
    assert len({goal.name for goal in GOALS.values()}) == len(GOALS)
