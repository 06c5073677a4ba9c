"""Every part of the registries is whole: second formulation, a test that it bites, documentation, a name.

That formulas are right, `referee/test_every_part.py` and `grasps/test_contact_kinds.py` see.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from pathlib import Path
from types import ModuleType
from typing import get_type_hints

import pytest
from planning.test_goal_order import ORDERS, WEIGHTS
from planning.test_limits_bite import BITES, BITTEN_ELSEWHERE
from random_formulations import LIMITS as RANDOM
from random_formulations import random_formulation

import synergrip
import synergrip.conic.goals
import synergrip.conic.limits
import synergrip.conic.solvers
import synergrip.grasps.contacts
import synergrip.grasps.shapes
from synergrip.cli.plan import plan as cli_plan
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.limits.file_key import FileKey
from synergrip.conic.limits.registry import LIMITS
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.kinds import KINDS
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.shapes.shapes import SHAPES
from synergrip.planning.solvers import SOLVERS
from synergrip.referee import formulas
from synergrip.simulation.geoms import GEOMS

DOCUMENTED = (Path(__file__).parent.parent / "docs" / "problem-file.md").read_text(encoding="utf-8")


def section(title: str) -> str:
    """Return a section of the description of the problem file."""
    return DOCUMENTED.split(f"\n## [{title}]", 1)[1].split("\n## ", 1)[0]


def in_files(package: ModuleType, kind: type) -> list[object]:
    """Return everything of a kind that the modules of a package hold at their top, by itself or by name."""
    registries = ("registry", "kinds", "shapes")
    names = [each.name for each in pkgutil.iter_modules(package.__path__) if each.name not in registries]
    modules = [importlib.import_module(f"{package.__name__}.{name}") for name in names]
    held = [value for module in modules for value in vars(module).values()]
    inside = [each for value in held if isinstance(value, dict) for each in value.values()]
    return [value for value in (*held, *inside) if isinstance(value, kind)]


@pytest.mark.parametrize("key", LIMITS, ids=lambda key: key.name)
def test_a_limit_is_whole(key: FileKey) -> None:
    grasp = random_formulation(0)[1].response.grasp
    kinds = {type(make(grasp)) for make in RANDOM.values()}
    there = {
        "its formula, in LIMITS of referee/formulas.py": key.kind in formulas.LIMITS,
        "a line in tests/planning/test_limits_bite.py": key.name in {*BITES, *BITTEN_ELSEWHERE},
        "a row in docs/problem-file.md": f"| `{key.name}` |" in section("limits"),
        "its name in synergrip/__init__.pyi": getattr(synergrip, key.kind.__name__, None) is key.kind,
        "a line in tests/random_formulations.py": key.kind in kinds or key.kind.__mro__[1] in kinds,
        "an Example: in its docstring": "Example:" in (key.kind.__doc__ or ""),
    }
    assert not [what for what, is_there in there.items() if not is_there]


@pytest.mark.parametrize("name", GOALS)
def test_a_goal_is_whole(name: str) -> None:
    goal = GOALS[name]
    there = {
        "its formula, in GOALS of referee/formulas.py": type(goal) in formulas.GOALS,
        "an order in tests/planning/test_goal_order.py": name in {x for order in ORDERS for x in (*order, *WEIGHTS)},
        "a word in docs/problem-file.md": bool(re.search(rf'[`"]{name}[`"]', section("goal"))),
        "its name in synergrip/__init__.pyi": getattr(synergrip, type(goal).__name__, None) is type(goal),
    }
    assert not [what for what, is_there in there.items() if not is_there]


@pytest.mark.parametrize("part", [*KINDS.values(), *SHAPES.values()], ids=lambda part: part.name)
def test_a_kind_of_contact_and_a_shape_have_their_names(part: type) -> None:
    """Their other parts are asked for in tests/grasps."""
    assert getattr(synergrip, part.__name__, None) is part, "its name is not in synergrip/__init__.pyi"
    assert "Example:" in (part.__doc__ or ""), "an Example: is not in its docstring"


@pytest.mark.parametrize("name", SHAPES)
def test_a_shape_is_where_plans_are_described(name: str) -> None:
    answers = (Path(__file__).parent.parent / "docs" / "answers.md").read_text(encoding="utf-8")
    sizes = ", ".join(f"`{size.name}_m`" for size in SHAPES[name].sizes)
    assert f"`{name}` {{{sizes}" in answers, f"`{name}` {{{sizes}}} is not in the row `object` of docs/answers.md"


def test_what_simulate_plays_are_shapes() -> None:
    assert GEOMS.keys() <= SHAPES.keys()


@pytest.mark.parametrize("name", SOLVERS)
def test_a_solver_is_documented(name: str) -> None:
    option = str(get_type_hints(cli_plan, include_extras=True)["solver"].__metadata__[0].help)
    there = {
        "a word in plan() of planning/planning.py": f'"{name}"' in (synergrip.plan.__doc__ or ""),
        "a word in the help of --solver in cli/plan.py": name in option,
    }
    assert not [what for what, is_there in there.items() if not is_there]


def test_no_kind_shape_or_solver_is_left_out_of_its_registry() -> None:
    for package, base, registry in (
        (synergrip.grasps.contacts, ContactKind, KINDS), (synergrip.grasps.shapes, Shape, SHAPES),
    ):  # fmt: skip
        found = {c for c in in_files(package, type) if isinstance(c, type) and issubclass(c, base)}
        assert {c for c in found if not inspect.isabstract(c)} == set(registry.values())
        assert all(name == part.name for name, part in registry.items())
    files = {each.name.rstrip("_") for each in pkgutil.iter_modules(synergrip.conic.solvers.__path__)}
    others = {"banded", "by_structure", "interrupts", "qpsolvers", "some_cones"}
    assert files - SOLVERS.keys() == others, "a file of conic/solvers is not in SOLVERS"


def test_nothing_that_a_file_offers_is_left_out_of_its_registry() -> None:
    keys = {key.name for key in in_files(synergrip.conic.limits, FileKey) if isinstance(key, FileKey)}
    assert keys == {key.name for key in LIMITS}
    assert len(LIMITS) == len({key.name for key in LIMITS})
    assert set(in_files(synergrip.conic.goals, Goal)) == set(GOALS.values())
    assert len({goal.name for goal in GOALS.values()}) == len(GOALS)
