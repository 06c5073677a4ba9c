"""Many grasps at once against one by one: the same maps, ranks and bases, and what is refused is told, not raised.

Bases are compared entry by entry: `canonical` makes each from its subspace alone, so singular values that tie turn
nothing, and a basis that is another one, or has another sign or order, is a failure.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np
import pytest
from judged_response import stiff_grasp
from random_grasps import compliance, random_grasp

import synergrip.statics.responses as responses_module
from synergrip.errors import InputError, NotRestrainedError, RigidContactError
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.grasps.scale import Metric
from synergrip.grasps.stack import GraspStack, Matrices
from synergrip.linalg import frozen
from synergrip.statics.analyses import Analyses, analyse_many
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.response import Maps
from synergrip.statics.subspaces import Bases
from synergrip.statics.theorem1 import Coordinates

FORMS = {
    "3 hard": {"kinds": ["hard"] * 3, "n_q": 9, "n_z": 4},
    "4 soft": {"kinds": ["soft"] * 4, "n_q": 8, "n_z": 5},
    "mixed": {"kinds": ["hard", "soft", "frictionless", "soft"], "n_q": 6, "n_z": 4},
    "degenerate": {"kinds": ["hard", "soft", "hard"], "n_q": 7, "n_z": 4, "degenerate": True},
    "more synergies than forces": {"kinds": ["hard", "hard", "hard"], "n_q": 14, "n_z": 12},
    "joints rigid": {"kinds": ["hard", "soft", "soft"], "n_q": 6, "n_z": 3, "compliances": ("full", "zero", "zero")},
}


def grasps_of(name: str, count: int = 40) -> list[Grasp]:
    return [random_grasp(np.random.default_rng(seed), **FORMS[name]) for seed in range(count)]


def stiff_ones(count: int = 40) -> list[Grasp]:
    """Contacts far stiffer than the synergies behind them, ever more so: the last need twice the digits."""
    grasps = grasps_of("4 soft", count)
    sizes = np.geomspace(1e-4, 1e-15, count)
    return [
        replace(grasp, C_s=frozen(size * np.eye(grasp.n_l)), C_q=frozen(0 * grasp.C_q), C_z=frozen(0.07 * np.eye(5)))
        for grasp, size in zip(grasps, sizes, strict=True)
    ]


GREEDY = 10.0
"""How many times a difference of subspaces a greedy basis of them may differ by."""


def same(ours: np.ndarray, theirs: np.ndarray, stated: float = 0.0) -> bool:
    """Equal to 1e-12, or to the error that both state, each of which may be lost the other way."""
    size = float(np.abs(theirs).max(initial=0.0))
    return ours.shape == theirs.shape and bool(np.all(np.abs(ours - theirs) <= max(1e-12, 2 * stated) * size))


def turned(ours: Analysis, theirs: Analysis) -> float:
    """By how much bases differ at most (first order), given by how much the force maps they are of really do differ.

    More where a force is weaker than the largest; 0 where the maps are equal to the last digit.
    """
    forces = theirs.spaces.decisions["forces"].singular_values[: theirs.spaces.dimensions[0]]
    weight = theirs.response.scale.force[:, None]
    one, other = (weight * each.response.dlambda_dzr for each in (ours, theirs))
    apart = float(np.linalg.norm(one - other) / (np.linalg.norm(other) or 1.0))
    return GREEDY * apart / max(float(forces.min(initial=1.0)), 1e-300)


def assert_same(ours: Analysis, theirs: Analysis) -> None:
    for field in fields(Maps):
        stated = theirs.response.accuracy[field.name].error
        assert same(getattr(ours.response, field.name), getattr(theirs.response, field.name), stated), field.name
    turn = turned(ours, theirs)
    for field in fields(Bases):
        doubt = turn if field.name == "E_s" else 0.0
        assert same(getattr(ours.spaces, field.name), getattr(theirs.spaces, field.name), doubt), field.name
    for name, decision in theirs.spaces.decisions.items():
        mine = ours.spaces.decisions[name]
        assert (mine.rank, mine.ambiguous) == (decision.rank, decision.ambiguous), name
        assert np.allclose(mine.singular_values, decision.singular_values, rtol=0, atol=1e-12), name
    motion = theirs.response.du_dzr
    apart = float(np.abs(ours.response.du_dzr - motion).max(initial=0.0)) / (
        float(np.abs(motion).max(initial=0)) or 1.0
    )
    assert same(ours.coordinates.M, theirs.coordinates.M, turn + apart)
    assert_inverse(ours.coordinates)
    assert ours.spaces.ambiguous == theirs.spaces.ambiguous
    assert ours.response.accuracy.keys() == theirs.response.accuracy.keys()


def assert_inverse(found: Coordinates) -> None:
    """As rounding leaves it in units of the rows, which are N, m and 1."""
    rows = np.linalg.norm(found.M, axis=-1, keepdims=True)
    M, inverse = found.M / rows, found.inverse * rows.T
    lost = np.abs(M @ inverse - np.eye(len(M))).max(initial=0.0)
    assert lost <= 1e-14 * len(M) * (np.linalg.norm(M) * np.linalg.norm(inverse) if M.size else 1.0)


def assert_all_same(grasps: Sequence[Grasp], together: Analyses) -> None:
    places = np.concatenate([group.places for group in together.groups])
    assert sorted([*places, *together.refusals]) == list(range(len(grasps)))
    for place in places:
        assert_same(together.at(int(place)), analyse(grasps[place]))


@pytest.mark.parametrize("name", FORMS)
def test_many_at_once_are_as_one_by_one(name: str) -> None:
    grasps = grasps_of(name)
    together = analyse_many(grasps)
    assert not together.refusals
    assert len(together.one_by_one) == 0
    assert_all_same(grasps, together)
    for group in together.groups:
        assert sum(group.dimensions) == grasps[0].n_z
        assert group.response.dlambda_dzr.shape == (len(group.places), grasps[0].n_l, grasps[0].n_z)


def test_what_needs_twice_the_digits_gets_them_and_is_counted() -> None:
    grasps = stiff_ones()
    together = analyse_many(grasps)
    assert 0 < len(together.one_by_one) < len(grasps)
    assert_all_same(grasps, together)


def test_grasps_of_any_stiffness_one_at_a_time() -> None:
    """Forms that differ from grasp to grasp: stacks of one, refusals and doubtful ranks included."""
    verdicts, ranks = set(), set()
    for seed in range(60):
        grasp = stiff_grasp(seed)
        together = analyse_many([grasp])
        for refusal in together.refusals.values():
            verdicts.add(type(refusal))
            with pytest.raises(type(refusal)) as caught:
                analyse(grasp)
            assert str(caught.value) == str(refusal)
            with pytest.raises(type(refusal)):
                together.at(0)
        if not together.refusals:
            alone = analyse(grasp)
            assert_same(together.at(0), alone)
            ranks.add(alone.response.restraint.rank)
    assert verdicts == {RigidContactError}
    assert min(ranks) < max(ranks) == 6


def test_dimensions_that_differ_make_groups() -> None:
    mixed = grasps_of("degenerate", 12)
    plain = [
        random_grasp(np.random.default_rng(50 + s), **(FORMS["degenerate"] | {"degenerate": False})) for s in range(12)
    ]
    grasps = [grasp for pair in zip(mixed, plain, strict=True) for grasp in pair]
    together = analyse_many(grasps)
    dimensions = [group.dimensions for group in together.groups]
    assert len(dimensions) > 1
    assert dimensions == sorted(set(dimensions), reverse=True)
    assert_all_same(grasps, together)


def test_refusals_are_told_and_stop_nothing() -> None:
    grasps = grasps_of("3 hard", 9)
    line = tuple(replace(c, point=frozen([0.01 * i, 0.0, 0.0])) for i, c in enumerate(grasps[2].contacts))
    on_the_line = frozen([0, 0, 0, 0.1, 0, 0])  # a moment that nothing resists
    grasps[2] = replace(grasps[2], contacts=line, G=grasp_matrix(line), w_0=on_the_line)
    nothing = {name: frozen(np.zeros_like(getattr(grasps[6], name))) for name in ("C_s", "C_q", "C_z")}
    grasps[6] = replace(grasps[6], **nothing)
    together = analyse_many(grasps)
    assert {place: type(why) for place, why in together.refusals.items()} == {
        2: NotRestrainedError,
        6: RigidContactError,
    }
    assert together.one_by_one.tolist() == [2, 6]
    for place, why in together.refusals.items():
        with pytest.raises(type(why)) as caught:
            analyse(grasps[place])
        assert str(caught.value) == str(why)
    assert_all_same(grasps, together)


def test_nothing_but_refusals() -> None:
    grasp = grasps_of("3 hard", 1)[0]
    nothing = {name: frozen(np.zeros_like(getattr(grasp, name))) for name in ("C_s", "C_q", "C_z")}
    together = analyse_many([replace(grasp, **nothing)] * 3)
    assert together.groups == ()
    assert sorted(together.refusals) == [0, 1, 2]


@pytest.mark.parametrize("name", ["4 soft", "degenerate"])
def test_copies_of_one_grasp_have_equal_answers(name: str) -> None:
    grasp = grasps_of(name, 1)[0]
    group, *others = analyse_many([grasp] * 17).groups
    assert others == []
    arrays = [getattr(group.response, f.name) for f in fields(Maps)] + [
        getattr(group.spaces, f.name) for f in fields(Bases)
    ]
    for array in (*arrays, group.coordinates.M, group.coordinates.inverse):
        assert np.array_equal(array, np.broadcast_to(array[:1], array.shape))
    assert_same(group.at(16), analyse(grasp))


def test_a_singular_system_sends_no_other_grasp_away(monkeypatch: pytest.MonkeyPatch) -> None:
    grasps = grasps_of("3 hard", 20)
    right, singular = responses_module.maps_in_float64, grasps[13].J

    def refusing(matrices: Matrices, metric: Metric, *arithmetic: object) -> object:
        if any(np.array_equal(J, singular) for J in matrices.J):
            raise np.linalg.LinAlgError("Singular matrix")
        return right(matrices, metric, *arithmetic)

    monkeypatch.setattr(responses_module, "maps_in_float64", refusing)
    together = analyse_many(grasps)
    assert together.one_by_one.tolist() == [13]
    assert_all_same(grasps, together)


def test_references_of_a_group_come_back() -> None:
    rng = np.random.default_rng(1)
    group = analyse_many(grasps_of("degenerate", 6)).groups[0]
    dz_r = rng.normal(size=(len(group.places), 5, 4))
    back = group.coordinates.references(*group.coordinates.coordinates(dz_r))
    assert np.abs(back - dz_r).max() < 1e-9
    one = group.at(0).coordinates
    assert np.allclose(one.references(*one.coordinates(dz_r[0])), back[0], atol=1e-12)
    assert group.coordinates.condition == pytest.approx(max(group.at(i).coordinates.condition for i in range(6)))


def test_a_grasp_varied_by_arrays_is_the_grasps_themselves() -> None:
    rng = np.random.default_rng(3)
    grasp = grasps_of("4 soft", 1)[0]
    C_s = np.stack([compliance(rng, 16, 1e-3, "full") for _ in range(8)])
    J = grasp.J + 1e-3 * rng.normal(size=(8, *grasp.J.shape))
    stack = GraspStack.varied(grasp, C_s=C_s, J=J)
    alone = [replace(grasp, C_s=frozen(C_s[i]), J=frozen(J[i])) for i in range(8)]
    assert len(stack) == 8
    assert_all_same(alone, analyse_many(stack))
    assert np.array_equal(stack[-1].J, J[-1])
    assert [np.array_equal(one.C_s, C_s[2 + i]) for i, one in enumerate(stack[2:5])] == [True] * 3
    single = GraspStack.varied(grasp, J=J[:1])
    assert np.array_equal(single[0].J, J[0])


@pytest.mark.parametrize(
    ("arrays", "told"),
    [
        ({"J": np.zeros((2, 3, 3))}, r"J: expected shape \(N, 9, 9\)"),
        ({"J": "much"}, "J: expected numbers"),
        ({"C_s": np.full((2, 9, 9), np.nan)}, "C_s: expected finite numbers, got nan"),
        ({"C_s": np.stack([np.eye(9), np.triu(np.ones((9, 9)))])}, r"C_s\[1\]: is not symmetric"),
        ({"C_s": np.stack([np.eye(9), -np.eye(9)])}, r"C_s\[1\]: is not positive semidefinite"),
        ({"w_0": np.zeros((2, 6)), "S": np.zeros((3, 9, 4))}, "arrays of one number of grasps, got w_0 2, S 3"),
        ({"mass": np.ones(3)}, "mass: is no array of a grasp; expected one of points, G"),
        ({}, "no array at all"),
    ],
)  # fmt: skip
def test_arrays_that_do_not_fit_are_named(arrays: dict[str, object], told: str) -> None:
    with pytest.raises(InputError, match=told):
        GraspStack.varied(grasps_of("3 hard", 1)[0], **arrays)


def test_grasps_that_do_not_go_together_are_named() -> None:
    grasps = [*grasps_of("3 hard", 2), *grasps_of("4 soft", 1)]
    with pytest.raises(InputError, match=r"grasps\[2\]: has contacts with components \(ntom, .*grasps\[0\] has"):
        analyse_many(grasps)
    with pytest.raises(InputError, match="grasps: expected at least one"):
        analyse_many([])
    with pytest.raises(InputError, match=r"grasps\[1\]: expected a Grasp, got str"):
        analyse_many([grasps[0], "ball"])  # type: ignore[list-item]
    with pytest.raises(InputError, match="place: expected a place from 0 to 1, got 5"):
        analyse_many(grasps[:2]).at(5)
