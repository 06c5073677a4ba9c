"""What every kind of contact must have, and that each means what its formula says."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from driven_grasp import driven

from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.friction_reserve import FrictionReserve
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.pyramids import pyramid
from synergrip.conic.rows import Item
from synergrip.errors import InputError
from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.contacts.elliptic_soft_finger import EllipticSoftFinger
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.kinds import KINDS, PARAMETERS
from synergrip.grasps.contacts.patch_contact import PatchContact
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen
from synergrip.planning.arrays import ARRAYS
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem
from synergrip.referee.friction import FORMULAS
from synergrip.reports.pictures.forces import contact_forces
from synergrip.tasks.timed_task import TimedTask, still

DOCS = Path(__file__).parents[2] / "docs"
EACH: list[ContactKind] = [
    HardFinger(friction=0.6),
    SoftFinger(friction=0.6, spin_friction=0.004),
    Frictionless(),
    EllipticSoftFinger(friction=0.8, cross_friction=0.3, spin_friction=0.004),
    PatchContact(friction=0.6, spin_friction=0.004, patch_radius=0.007),
]


@dataclass(frozen=True, kw_only=True)
class Leaning(ContactKind):
    """A kind of one's own whose only moment is one about a tangent, not the one about the normal."""

    name: ClassVar[str] = "leaning"
    components: ClassVar[tuple[str, ...]] = ("n", "t", "o", "m_o")

    @property
    def cones(self) -> tuple[Array, ...]:
        return (frozen(np.diag([0.5, 1.0, 1.0, 100.0])),)


TIPS = "'finger1/tip','finger2/tip','finger3/tip'"


def contact(kind: ContactKind, name: str = "C", point: tuple[float, ...] = (0.0, 0.0, 0.0)) -> Contact:
    return Contact(name=name, kind=kind, point=frozen(point), frame=contact_frame(np.array([1.0, 0.0, 0.0])))


def margin(kind: ContactKind, force: Array) -> float:
    """The slip margin by the second formulation's formula, which knows no cone matrices."""
    n = float(force[0])
    parts = FORMULAS[kind.name](kind, force[None, :], 1.0)
    found = min(factor * n - (0.0 if tail is None else float(np.linalg.norm(tail))) for _, factor, tail in parts)
    return min(found, n) if n < 0 else found


def forces(kind: ContactKind, seed: int, count: int = 200) -> Array:
    """Random forces, some of them inside and some outside of the cones."""
    rng = np.random.default_rng(seed)
    sizes = np.array([1.0 if not c.startswith("m") else 5e-3 for c in kind.components])
    return np.abs([2.0, *np.zeros(len(sizes) - 1)]) + rng.normal(size=(count, len(sizes))) * sizes


def test_each_kind_in_the_registry_has_all_its_parts() -> None:
    assert {type(kind).name for kind in EACH} == KINDS.keys() == FORMULAS.keys()
    problem_file, theory = ((DOCS / name).read_text() for name in ("problem-file.md", "theory.md"))
    for name, kind in KINDS.items():
        assert {each.name for each in fields(kind)} == {each.name for each in kind.parameters}, name
        assert f"`{name}`" in problem_file, f"{name} is not in docs/problem-file.md"
        assert kind.__name__ in theory, f"{kind.__name__} is not in docs/theory.md"
        assert kind.components[0] == "n"
    for name in PARAMETERS:
        assert f"`{name}`" in problem_file, f"{name} is not in docs/problem-file.md"


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_the_slip_margin_is_that_of_the_formula(kind: ContactKind) -> None:
    every = forces(kind, 1)
    found, expected = contact(kind).slip_margin(every), [margin(kind, force) for force in every]
    assert found == pytest.approx(np.array(expected), abs=1e-12)
    assert np.any(found > 0)
    assert np.any(found < 0)


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_each_cone_is_that_of_the_formula_with_a_share_of_the_friction(kind: ContactKind) -> None:
    """Side by side, in the same units, so that multipliers mean the same; a share narrows as `slippery` does."""
    every = forces(kind, 8)
    for share in (1.0, 0.7):
        parts, cones = list(FORMULAS[kind.name](kind, every, share)), kind.slippery(share).cones
        assert [side for side, _, _ in parts] == list(kind.sides)
        for (_, factor, tail), W in zip(parts, cones, strict=True):
            image = every @ W.T
            assert factor * every[:, 0] == pytest.approx(image[:, 0], abs=1e-12)
            norm = np.zeros(len(every)) if tail is None else np.linalg.norm(tail, axis=1)
            assert norm == pytest.approx(np.linalg.norm(image[:, 1:], axis=1), abs=1e-12)


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_a_tangential_force_of_the_size_of_the_margin_may_come_on_top(kind: ContactKind) -> None:
    """In whatever direction: this is what the margin is worth in newtons, and no more of it along the worst one."""
    if len(kind.components) < 3:
        return
    for force in forces(kind, 2):
        left = margin(kind, force)
        for angle in np.linspace(0, 2 * np.pi, 12):
            more = force.copy()
            more[1:3] += left * np.array([np.cos(angle), np.sin(angle)])
            assert left <= 0 or margin(kind, more) >= -1e-12
    slips = [margin(kind, np.array([1.0, *pure, *np.zeros(len(kind.components) - 3)])) for pure in
             1.0001 * kind.least_friction * np.eye(2)]  # fmt: skip
    assert min(slips) < 0


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_no_component_is_larger_than_the_cones_have_it(kind: ContactKind) -> None:
    every = forces(kind, 3, 4000)
    inside = every[contact(kind).slip_margin(every) >= 0]
    shares = np.abs(inside) / inside[:, :1]
    assert np.all(shares <= kind.most + 1e-12)
    rims = []
    for i in range(1, len(kind.components)):
        force = np.zeros(len(kind.components))
        force[0], force[i] = 1.0, kind.most[i]
        rims.append(margin(kind, force))
    assert rims == pytest.approx([0.0] * len(rims), abs=1e-12)


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_pyramids_are_inscribed_in_every_cone(kind: ContactKind) -> None:
    for cone, _ in zip(kind.cones, kind.sides, strict=True):
        if len(cone) == 1:
            continue
        images = forces(kind, 4, 2000) @ cone.T
        inside = np.all(images @ pyramid(8, len(cone)).T >= 0, axis=1)
        held = images[:, 0] >= np.linalg.norm(images[:, 1:], axis=1)
        assert np.all(held[inside])
        assert np.mean(inside[held]) > 0.8


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_less_friction_narrows_the_cones_and_nothing_else(kind: ContactKind) -> None:
    every = forces(kind, 5)
    less = kind.slippery(0.5)
    assert np.all(contact(less).slip_margin(every) <= contact(kind).slip_margin(every).clip(0) + 1e-12)
    assert less.least_friction == pytest.approx(0.5 * kind.least_friction)
    for parameter in kind.parameters:
        share = 0.5 if parameter.name in kind.frictions else 1.0
        assert getattr(less, parameter.name) == share * getattr(kind, parameter.name)


def test_an_ellipse_with_one_friction_is_a_soft_finger() -> None:
    soft = SoftFinger(friction=0.5, spin_friction=0.006)
    round_ = EllipticSoftFinger(friction=0.5, cross_friction=0.5, spin_friction=0.006)
    every = forces(soft, 6)
    assert contact(round_).slip_margin(every) == pytest.approx(contact(soft).slip_margin(every), abs=1e-12)


def test_the_centre_of_pressure_of_a_patch_is_where_its_moments_say() -> None:
    """What pressures spread over the disc make of n, m_t and m_o is inside; a point on the rim is on the cone."""
    rng, patch = np.random.default_rng(7), PatchContact(friction=0.6, spin_friction=0.004, patch_radius=0.007)
    for _ in range(50):
        radius, angle = 0.007 * np.sqrt(rng.uniform(size=20)), rng.uniform(0, 2 * np.pi, 20)
        places = np.column_stack([np.zeros(20), radius * np.cos(angle), radius * np.sin(angle)])
        pressures = rng.uniform(size=20)
        moments = np.cross(places, pressures[:, None] * np.array([1.0, 0.0, 0.0])).sum(axis=0)
        n = pressures.sum()
        force = np.array([n, 0.0, 0.0, *moments])
        assert contact(patch).slip_margin(force) > 0
        middle = (pressures[:, None] * places).sum(axis=0) / n
        assert middle[1:] == pytest.approx(np.array([-moments[2], moments[1]]) / n, abs=1e-12)
    on_rim = np.array([1.0, 0, 0, 0, 0.007 * np.sin(0.4), -0.007 * np.cos(0.4)])
    assert contact(patch).slip_margin(on_rim) == pytest.approx(0.0, abs=1e-12)


# in plans


def on_a_table(
    kind: ContactKind, wrench: list[float], limits: tuple[NormalForce, ...] = ()
) -> tuple[object, TimedTask]:
    """One contact from below at the origin; each component has a synergy of its own."""
    one = replace(contact(kind), frame=contact_frame(np.array([0.0, 0.0, 1.0])))
    task = TimedTask(frozen([0.0]), frozen([wrench]), still(frozen([0.0])), 0.0, (), (LeastEffort(),))
    return driven([one]), task


@pytest.mark.parametrize("solver", ["clarabel", "cvxpy"])
@pytest.mark.parametrize(("arm", "verdict"), [(0.0068, "feasible"), (0.0072, "infeasible")])
def test_a_patch_carries_a_load_beside_its_middle_until_it_tips(arm: float, verdict: str, solver: str) -> None:
    """Bite of the second cone: the friction cone alone would hold both."""
    patch = PatchContact(friction=0.6, spin_friction=0.004, patch_radius=0.007)
    grasp, task = on_a_table(patch, [0, 0, -2.0, 0, 2.0 * arm, 0])
    assert plan(grasp, task, SOLVERS[solver]).verdict == verdict
    wide, _ = on_a_table(replace(patch, patch_radius=0.02), [0, 0, -2.0, 0, 0, 0])
    assert plan(wide, task, SOLVERS[solver]).verdict == "feasible"


def test_the_cones_of_a_patch_are_told_apart_by_name_and_side() -> None:
    patch = PatchContact(friction=0.6, spin_friction=0.004, patch_radius=0.007)
    grasp, task = on_a_table(patch, [0, 0, -2.0, 0, 2.0 * 0.0072, 0])
    found = plan(grasp, task)
    assert isinstance(found, Infeasible)
    assert [(conflict.key, conflict.items) for conflict in found.conflicts] == [("friction cone", ("C",))]
    assert found.program is not None
    items = {item for block in found.program.blocks for item in block.items if block.limit == "friction cone"}
    assert items == {Item("C", "slip"), Item("C", "tipping")}


def pinched(kind: ContactKind, load: Array) -> tuple[Grasp, TimedTask]:
    """Two contacts on the x axis, pushed with 1 N at most, and a load (3,) along the axes of their frames."""
    left, right = contact(kind, "left", (-0.02, 0, 0)), contact(kind, "right", (0.02, 0, 0))
    right = replace(right, frame=frozen(right.frame * [-1, 1, -1]))
    wrench = frozen([[*(left.frame @ load), 0, 0, 0]])
    at = frozen([0.0])
    return driven([left, right]), TimedTask(at, wrench, still(at), 0.0, (NormalForce(0.0, 1.0),), (LeastEffort(),))


@pytest.mark.parametrize("solver", ["clarabel", "cvxpy"])
@pytest.mark.parametrize(
    ("load", "verdict"),
    [
        ((0, 1.59, 0), "feasible"),
        ((0, 1.61, 0), "infeasible"),
        ((0, 0, 0.59), "feasible"),
        ((0, 0, 0.61), "infeasible"),
    ],
)
def test_an_elliptic_finger_slips_more_easily_one_way(load: tuple[float, ...], verdict: str, solver: str) -> None:
    """Closed form: two contacts at 1 N carry 2 mu_t along t and 2 mu_o along o."""
    kind = EllipticSoftFinger(friction=0.8, cross_friction=0.3, spin_friction=0.004)
    assert plan(*pinched(kind, np.array(load)), SOLVERS[solver]).verdict == verdict


@pytest.mark.parametrize("kind", [kind for kind in EACH if "m" in kind.components], ids=lambda kind: kind.name)
def test_limits_of_friction_use_every_cone(kind: ContactKind) -> None:
    grasp, task = pinched(kind, np.array([0.0, 0.2, 0.1]))
    reserve = FrictionReserve(ratios=[0.5, 0.8])
    found = plan(grasp, replace(task, limits=(*task.limits, reserve)))
    assert isinstance(found, Plan)
    parts = [found.motion.forces[:, rows] for rows in grasp.rows]
    usage = reserve.usage(found.formulation, found.motion)
    slippery = [contact(kind.slippery(share)).slip_margin(part) for share, part in zip((0.5, 0.8), parts, strict=True)]
    assert pytest.approx(np.array(slippery)) == usage.value.T
    whole = FrictionCone(0.0).usage(found.formulation, found.motion)
    assert whole.value[0] == pytest.approx([margin(kind, part[0]) for part in parts])
    assert np.abs(slippery).min() < 1e-6  # the reserve is what decides


# in files


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_a_file_says_all_of_a_kind(kind: ContactKind) -> None:
    values = [f"{p.name}={getattr(kind, p.name)}" if not p.length else f"{p.name}='{1e3 * getattr(kind, p.name)} mm'"
              for p in kind.parameters]  # fmt: skip
    entries = [f"{name}='{3 + i} N{' m/rad' if name in ('spin_stiffness', 'tilt_stiffness') else '/mm'}'"
               for i, name in enumerate(kind.stiffnesses())]  # fmt: skip
    table = ",".join([f"at=[{TIPS}]", f"model='{kind.name}'", *values, *entries])
    grasp = load_problem("barrett-ball-hold", [f"contacts={{{table}}}"]).grasp
    found = grasp.contacts[0].kind
    assert type(found) is type(kind)
    assert [getattr(found, p.name) for p in kind.parameters] == pytest.approx(
        [getattr(kind, p.name) for p in kind.parameters]
    )
    stiff = {"n": 3e3, "t": 4e3, "o": 4e3, "m": 5.0, "m_t": 6.0, "m_o": 6.0}
    assert np.diag(grasp.C_s)[: len(kind.components)] == pytest.approx([1 / stiff[c] for c in kind.components])


@pytest.mark.parametrize("kind", [kind for kind in EACH if kind.parameters], ids=lambda kind: kind.name)
def test_parameters_are_judged(kind: ContactKind) -> None:
    for parameter in kind.parameters:
        for bad in (0.0, -0.1, np.nan, np.inf, "0.5", None, True, [0.5], 1j):
            with pytest.raises(InputError) as caught:
                replace(kind, **{parameter.name: bad})
            assert caught.value.issues[0].key == f"{type(kind).__name__}.{parameter.name}"


@pytest.mark.parametrize("kind", EACH, ids=lambda kind: kind.name)
def test_columns_of_forces_and_of_moments_have_their_units(kind: ContactKind) -> None:
    (lambdas,) = (array.columns for array in ARRAYS if array.key == "lambda")
    assert lambdas is not None
    units = {"n": "N", "t": "N", "o": "N", "m": "Nm", "m_t": "Nm", "m_o": "Nm"}
    wanted = [f"lambda_C_{component}_{units[component]}" for component in kind.components]
    assert list(lambdas.names(driven([contact(kind)]))) == wanted


@pytest.mark.parametrize("kind", [*EACH, Leaning()], ids=lambda kind: kind.name)
def test_forces_and_spins_are_drawn_whatever_the_components(kind: ContactKind) -> None:
    """Forces are those in the wrench on the object, spins the moment about the normal and none about a tangent."""
    touch, rows = contact(kind, point=(0.0, 0.0, 0.0)), np.arange(1.0, 1.0 + len(kind.components))
    drawn = contact_forces([touch], rows)
    wrench = grasp_matrix([touch]) @ rows
    assert drawn.forces[0] == pytest.approx(wrench[:3], abs=1e-12)
    assert drawn.spins[0] == pytest.approx(wrench[3:] @ touch.normal, abs=1e-12)


def test_a_kind_takes_numbers_of_any_sort() -> None:
    assert HardFinger(friction=np.float64(0.5)) == HardFinger(friction=np.array(0.5)) == HardFinger(friction=0.5)
    assert HardFinger(friction=1) == HardFinger(friction=1.0)
