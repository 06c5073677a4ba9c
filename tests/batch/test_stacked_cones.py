"""Cones and statics of many grasps as `plan_many` takes them, against those of each by itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

import numpy as np
import pytest
from random_cone_problems import grasp_like

from synergrip.batch.stacked_cones import stacked_cones
from synergrip.conic.affine import Affine
from synergrip.grasps.contacts.elliptic_soft_finger import EllipticSoftFinger
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.contacts.patch_contact import PatchContact
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stack import GraspStack
from synergrip.grasps.stacked_kinds import StackedKinds
from synergrip.linalg import Array
from synergrip.statics.analyses import analyse_many, analyses_for_plans
from synergrip.statics.response import Maps
from synergrip.statics.subspaces import Bases


@dataclass(frozen=True, kw_only=True)
class Slanted(HardFinger):
    """A finger whose second tangent is told along both."""

    @classmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """Rows mu n, t + o, o."""
        W = np.array(HardFinger.cones_with(values)[0])
        W[..., 1, 2] = 1.0
        return (W,)


def with_kinds(grasp: Grasp, *kinds: ContactKind) -> Grasp:
    contacts = tuple(replace(each, kind=kind) for each, kind in zip(grasp.contacts, kinds, strict=True))
    return replace(grasp, contacts=contacts)


def of_contacts(grasp: Grasp, friction: float, forces: Array) -> Array:
    """The slip margins by the contacts one by one."""
    margins = []
    for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
        images = [W @ forces[rows] for W in contact.kind.slippery(friction).cones]
        margins.append(min(float(image[0] - np.linalg.norm(image[1:])) for image in images))
    return np.array(margins)


@pytest.mark.parametrize("with_factors", [False, True])
def test_cones_of_contacts_of_several_classes_and_frictions_are_those_of_each_contact(with_factors: bool) -> None:
    rng, N = np.random.default_rng(0), 9
    grasps = []
    for k in range(N):
        soft = SoftFinger(friction=rng.uniform(0.1, 1.0), spin_friction=rng.uniform(0.002, 0.01))
        elliptic = EllipticSoftFinger(friction=0.8, cross_friction=rng.uniform(0.1, 1.0), spin_friction=0.004)
        grasps.append(with_kinds(grasp_like(rng, ["soft"] * 2), soft if k % 3 else elliptic, elliptic))
    factors = rng.uniform(0.1, 2.0, N) if with_factors else None
    forces = rng.normal(size=(N, grasps[0].n_l))
    (cones,) = stacked_cones(grasps[0], StackedKinds.of(grasps), factors)
    image = cones.images(forces)
    ours = image[..., 0] - np.linalg.norm(image[..., 1:], axis=-1)
    each = [of_contacts(g, 1.0 if factors is None else factors[k], forces[k]) for k, g in enumerate(grasps)]
    assert np.abs(ours - each).max() < 1e-12 * np.abs(each).max()
    few = [7, 2]
    (some,) = stacked_cones(grasps[7], StackedKinds.of(grasps).taken(few), None if factors is None else factors[few])
    assert np.array_equal(some.W, cones.taken(few).W)


def test_a_kind_whose_cone_takes_two_components_in_one_row_has_them_both() -> None:
    grasp = grasp_like(np.random.default_rng(1), ["hard"] * 3)
    kinds = StackedKinds.of([with_kinds(grasp, Slanted(friction=0.5), *(each.kind for each in grasp.contacts[1:]))])
    forces, factors = np.random.default_rng(2).normal(size=(4, 9)), np.array([0.5, 1.0, 1.5, 2.0])
    (cones,) = stacked_cones(grasp, kinds, factors)
    assert cones.columns is None
    straight, slanted = cones.images(forces)[:, 1], cones.images(forces)[:, 0]
    assert np.array_equal(straight[:, 1:], forces[:, 4:6])
    assert np.allclose(
        slanted, np.column_stack([0.5 * factors * forces[:, 0], forces[:, 1] + forces[:, 2], forces[:, 2]])
    )
    value = Affine(np.eye(9), np.zeros((4, 9)))
    assert np.allclose(cones.after(value)[0].matrix, cones.W)


def test_one_contact_with_two_cones_and_many_frictions() -> None:
    factors = np.array([0.3, 1.0, 1.7])
    kind = PatchContact(friction=0.6, spin_friction=0.003, patch_radius=0.008)
    slip, tipping = kind.cones_with({"friction": 0.6 * factors, "spin_friction": 0.003 * factors,
                                     "patch_radius": np.array(0.008)})  # fmt: skip
    for k, factor in enumerate(factors):
        own = kind.slippery(factor).cones
        assert np.allclose(slip[k], own[0], rtol=1e-15)
        assert np.array_equal(tipping[k], own[1])


@pytest.mark.parametrize(("kinds", "n_z"), [(["hard"] * 3, 5), (["soft"] * 4, 8), (["hard"] * 3, 2)])
def test_the_statics_that_plans_go_by_are_those_of_the_full_analysis(kinds: list[str], n_z: int) -> None:
    rng = np.random.default_rng(2)
    stack = GraspStack.of([grasp_like(rng, kinds, n_z) for _ in range(30)])
    ours, full = analyses_for_plans(stack), analyse_many(stack).groups
    assert ("forces" in ours[0].spaces.decisions) == (ours[0].dimensions[0] < len(kinds) * 3 - 6 or kinds[0] == "soft")
    for lean, whole in zip(ours, full, strict=True):
        assert np.array_equal(lean.places, whole.places)
        assert lean.dimensions == whole.dimensions
        assert np.array_equal(lean.response.figures, whole.response.figures)
        pairs = [(getattr(lean.response, f.name), getattr(whole.response, f.name)) for f in fields(Maps)]
        pairs += [(getattr(lean.spaces, f.name), getattr(whole.spaces, f.name)) for f in fields(Bases)]
        for one, other in pairs:
            assert np.abs(one - other).max(initial=0.0) <= 1e-12 * np.abs(other).max(initial=0.0)


def test_kinds_of_ones_own_need_cones_of_one_contact_only() -> None:
    values = {"friction": np.array([0.3, 0.6]), "spin_friction": np.array([0.002, 0.004])}
    one_by_one = ContactKind.cones_with.__func__(SoftFinger, values)  # type: ignore[attr-defined]
    (W,), (own,) = SoftFinger.cones_with(values), one_by_one
    np.testing.assert_array_equal(W, own)
