"""The statics in compiled lanes, against those of one grasp after the other; what is doubtful or wrong is left out."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest
from random_cone_problems import grasp_like, random_wrenches

import synergrip as sg
from synergrip.batch.fast_statics import Layout, lanes
from synergrip.batch.stated import each_of
from synergrip.linalg import Array
from synergrip.statics.analyses import analyses_for_plans
from synergrip.statics.each import Each
from synergrip.statics.response import Maps

FORMS = [(["hard"] * 3, 5), (["soft"] * 4, 8), (["hard", "soft", "hard"], 3), (["hard"] * 3, 3)]


def grasps_of(kinds: list[str], n_z: int, count: int = 11) -> list[sg.Grasp]:
    rng = np.random.default_rng(n_z)
    return [grasp_like(rng, kinds, n_z) for _ in range(count)]


def quick(stack: sg.GraspStack) -> object:
    pytest.importorskip("numba")
    from synergrip.batch.fast_statics import ClearStatics

    return ClearStatics(stack)(stack)


def largest(values: Array) -> float:
    return float(np.abs(values).max(initial=0.0))


@pytest.mark.parametrize(("kinds", "n_z"), FORMS)
def test_lanes_find_what_one_grasp_after_the_other_gives(kinds: list[str], n_z: int) -> None:
    grasps = grasps_of(kinds, n_z)
    found = quick(sg.GraspStack.of(grasps))
    assert found.places.tolist() == list(range(len(grasps)))
    for k, grasp in enumerate(grasps):
        alone, each = sg.analyse(grasp), found.each[k]
        assert found.like.spaces.dimensions == alone.spaces.dimensions
        for name in (field.name for field in fields(Maps)):
            theirs = getattr(alone.response, name)
            assert largest(getattr(each.response, name) - theirs) <= 1e-11 * largest(theirs)
        n_alpha = alone.spaces.dimensions[0]
        for own, theirs in ((each.spaces.E_s, alone.spaces.E_s), (each.spaces.Gamma_ucs, alone.spaces.Gamma_ucs)):
            assert np.allclose(own @ np.linalg.pinv(own), theirs @ np.linalg.pinv(theirs), atol=1e-9)
        ours = each.coordinates.inverse[:, :n_alpha] @ np.linalg.pinv(each.spaces.E_s)
        theirs = alone.coordinates.inverse[:, :n_alpha] @ np.linalg.pinv(alone.spaces.E_s)
        assert largest(ours - theirs) <= 1e-8 * largest(theirs)  # references that make internal forces and no motion


def test_a_hand_whose_joints_move_all_contacts_is_worked_out_beside_others() -> None:
    """What is 0 in most grasps is not left out in the one where it is not."""
    grasps = grasps_of(["hard"] * 3, 5)
    apart = np.random.default_rng(1).normal(scale=0.01, size=grasps[9].J.shape)
    grasps[9] = replace(grasps[9], J=grasps[9].J + apart, C_q=grasps[9].C_q + 1e-3 * apart.T @ apart)
    found = quick(sg.GraspStack.of(grasps))
    assert found.places.tolist() == list(range(len(grasps)))
    for k in (8, 9):
        theirs = sg.analyse(grasps[k]).response
        for name in (field.name for field in fields(Maps)):
            whole = getattr(theirs, name)
            assert largest(getattr(found.each.response, name)[k] - whole) <= 1e-10 * largest(whole)


def test_what_is_doubtful_is_left_to_others() -> None:
    grasps = grasps_of(["soft"] * 4, 8)
    doubtful = {
        2: replace(grasps[2], S=np.hstack([grasps[2].S[:, :-1], grasps[2].S[:, :1] * (1 + 1e-7)])),  # hardly 8 of them
        5: replace(grasps[5], C_s=grasps[5].C_s * np.logspace(0, 14, 16)),  # no digits are left in float64
        7: replace(grasps[7], S=0 * grasps[7].S),
    }
    mixed = [doubtful.get(k, grasp) for k, grasp in enumerate(grasps)]
    found = quick(sg.GraspStack.of(mixed))
    assert found.places.tolist() == [k for k in range(len(grasps)) if k not in doubtful]
    task = sg.Task(knots=1, limits=[sg.NormalForce(upper=10.0), sg.SlipMargin(0.1)], goals=[sg.LargestMargin()])
    wrenches = random_wrenches(np.random.default_rng(0), len(mixed))
    ours, theirs = (sg.plan_many(mixed, task, wrenches=wrenches, kernel=kernel) for kernel in ("numba", "numpy"))
    assert ours.verdicts.tolist() == theirs.verdicts.tolist()
    assert np.array_equal(ours.one_by_one, theirs.one_by_one)
    load = np.abs(wrenches[:, :3]).max()
    assert np.allclose(ours.largest_margin, theirs.largest_margin, atol=1e-6 * load, equal_nan=True)


def rows_of(each: Each, layout: Layout) -> Array:
    """Statics as the compiled lanes put them down, those that they found clear."""
    maps, nothing = each.response, np.zeros((len(each), layout.q + layout.z, 6))
    of_load = [maps.dlambda_dw, maps.du_dw, nothing, maps.dz_dw, maps.dq_dw]
    names = ("dlambda", "du", "dtau", "dsigma", "dz", "dq")
    of_references = [getattr(maps, f"{name}_dzr") for name in names]
    whole = np.concatenate([np.concatenate(of_references, axis=1), np.concatenate(of_load, axis=1)], axis=2)
    bases, M = each.spaces, each.coordinates
    parts = (np.ones((len(each), 1)), whole, bases.E_s, bases.Gamma_ucs, bases.Gamma_zcs, M.M, M.inverse)
    return np.concatenate([part.reshape(len(each), -1) for part in parts], axis=1)


@pytest.mark.parametrize(("kinds", "n_z"), FORMS)
def test_statics_that_are_wrong_are_not_confirmed(kinds: list[str], n_z: int) -> None:
    """Those of the other way, in NumPy, are right; with one entry a little off they are not."""
    pytest.importorskip("numba")
    stack = sg.GraspStack.of(grasps_of(kinds, n_z))
    (group,) = analyses_for_plans(stack)
    right, layout = each_of(group), Layout.of(stack.like.n_l, *stack.like.S.shape)
    assert layout is not None
    assert lanes(stack, layout, rows_of(right, layout), known=True).all()

    def altered(part: str, name: str) -> Each:
        whole = getattr(right, part)
        values = np.array(getattr(whole, name))
        values[::2, 0, -1] += 1e-5 * np.abs(values).max(axis=(-2, -1))[::2]
        return replace(right, **{part: replace(whole, **{name: values})})

    wrong = [("response", name) for name in ("dlambda_dzr", "dlambda_dw", "dq_dzr", "dq_dw", "du_dzr", "du_dw")]
    wrong += [("spaces", "E_s")]
    wrong += [("spaces", "Gamma_ucs")] * (right.spaces.Gamma_ucs.shape[-1] > 0)
    for part, name in wrong:
        found = lanes(stack, layout, rows_of(altered(part, name), layout), known=True)
        assert not found[::2].any(), name
        assert found[1::2].all(), name
    wrong = [("M", 0), ("M", -1), ("inverse", 0), ("inverse", -1)]
    for name, last in wrong:  # rows of M, and columns of its inverse, are forces first and rigid motions last
        values = np.array(getattr(right.coordinates, name))
        row = values[::2, last] if name == "M" else values[::2, :, last]
        row[:, 0] += 1e-5 * np.abs(row).max(axis=-1)
        other = replace(right, coordinates=replace(right.coordinates, **{name: values}))
        found = lanes(stack, layout, rows_of(other, layout), known=True)
        assert not found[::2].any(), name
        assert found[1::2].all(), name
