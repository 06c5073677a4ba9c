"""Grasps that leave the object free to move: everything on the complement of null(G'), against other formulations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from elastic_grasp import held_motions
from free_grasps import FORMS, free_grasp, moved, unloaded
from random_grasps import compliance

from synergrip.errors import NotRestrainedError
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen
from synergrip.statics import coordinates, respond, subspaces
from synergrip.statics.analyses import analyse_many
from synergrip.statics.analysis import analyse
from synergrip.statics.response import Maps
from synergrip.statics.restraint import NO_LOAD
from synergrip.statics.subspaces import Bases

SEEDS = range(60)


def size(values: np.ndarray) -> float:
    return float(np.abs(values).max(initial=0.0))


@pytest.mark.parametrize("form", FORMS)
def test_theorem_1_holds_on_the_complement(form: str) -> None:
    """(34) exactly, M invertible, each basis where it belongs; dimensions from null spaces worked out here."""
    found = set()
    for seed in SEEDS:
        rng = np.random.default_rng(seed)
        grasp = free_grasp(rng, form)
        response = respond(grasp)
        spaces = subspaces(response)
        scale, JS, coords = response.scale, grasp.J @ grasp.S, coordinates(response, spaces)
        assert response.free_twists.shape == (6, FORMS[form])
        assert size(grasp.G.T @ response.free_twists) < 1e-14
        assert not spaces.ambiguous
        both = np.linalg.svd(np.hstack([JS, -grasp.G.T]), compute_uv=False)
        null = JS.shape[1] + 6 - int(np.sum(both > 1e-9 * both[0]))
        idle = JS.shape[1] - np.linalg.matrix_rank(JS, tol=1e-9 * size(JS))
        motions = null - idle - FORMS[form]
        assert spaces.dimensions == (grasp.n_z - motions - idle, motions, idle), seed
        assert size(grasp.G @ spaces.E_s) < 1e-14
        assert size(JS @ spaces.Gamma_zcs - grasp.G.T @ spaces.Gamma_ucs) < 1e-12
        assert size((scale.motion @ response.free_twists).T @ scale.motion @ spaces.Gamma_ucs) < 1e-13
        dz_r = rng.normal(size=(3, grasp.n_z))
        assert size(coords.references(*coords.coordinates(dz_r)) - dz_r) < 1e-9 * size(dz_r)
        found.add(spaces.dimensions)
    assert len(found) > 1


@pytest.mark.parametrize("form", FORMS)
def test_maps_are_those_of_reduced_coordinates(form: str) -> None:
    """Object motions in a basis of those that contacts see, wrenches against the same basis: no free motion is left."""
    for seed in SEEDS:
        rng = np.random.default_rng(seed)
        grasp = free_grasp(rng, form)
        held, JS = held_motions(grasp), grasp.J @ grasp.S
        C = grasp.C_s + grasp.J @ grasp.C_q @ grasp.J.T + JS @ grasp.C_z @ JS.T
        G, r = held.T @ grasp.G, held.shape[1]
        assert r == 6 - FORMS[form]
        system = np.linalg.inv(np.block([[C, G.T], [G, np.zeros((r, r))]]))
        forces, motions = system[: grasp.n_l], held @ system[grasp.n_l :]
        response = respond(grasp)
        for ours, theirs in (
            (response.dlambda_dzr, forces[:, : grasp.n_l] @ JS),
            (response.dlambda_dw, -forces[:, grasp.n_l :] @ held.T),
            (response.du_dzr, motions[:, : grasp.n_l] @ JS),
            (response.du_dw, -motions[:, grasp.n_l :] @ held.T),
        ):
            assert size(ours - theirs) < 1e-9 * size(theirs), seed
        load = unloaded(rng, grasp, 5)
        assert size(load + load @ response.dlambda_dw.T @ grasp.G.T) < 1e-12 * size(load)


def in_the_plane(grasp: Grasp) -> np.ndarray:
    """The grasp matrix (3, n_c) of smooth contacts in the plane x, y: force along x, along y, moment about z."""
    normals, points = (np.array([getattr(c, name) for c in grasp.contacts]) for name in ("frame", "point"))
    x, y = normals[:, 0, 0], normals[:, 1, 0]
    return np.array([x, y, points[:, 0] * y - points[:, 1] * x])


@pytest.mark.parametrize("seed", range(20))
def test_a_planar_grasp_is_that_of_three_rows(seed: int) -> None:
    """Its own closed forms, ``K G' (G K G')^-1`` and so on, in the plane; nothing there is free."""
    rng = np.random.default_rng(seed)
    grasp = free_grasp(rng, "plane", placed=False)
    G, JS = in_the_plane(grasp), grasp.J @ grasp.S
    K = np.linalg.inv(grasp.C_s + grasp.J @ grasp.C_q @ grasp.J.T + JS @ grasp.C_z @ JS.T)
    right = K @ G.T @ np.linalg.inv(G @ K @ G.T)
    response, plane = respond(grasp), [0, 1, 5]
    assert size(response.dlambda_dw[:, plane] + right) < 1e-9 * size(right)
    force = (np.eye(grasp.n_l) - right @ G) @ K @ JS
    assert size(response.dlambda_dzr - force) < 1e-9 * size(force)
    motion = np.linalg.inv(G @ K @ G.T) @ G @ K @ JS
    assert size(response.du_dzr[plane] - motion) < 1e-9 * size(motion)
    assert size(response.du_dzr[[2, 3, 4]]) < 1e-13 * size(motion)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("seed", range(5))
def test_frames_and_units_change_nothing(form: str, seed: int) -> None:
    """The object frame elsewhere and turned, and lengths a thousand times as large with compliances to match."""
    rng = np.random.default_rng(seed)
    grasp = replace(free_grasp(rng, form), C_q=frozen(np.zeros((7, 7))), C_z=frozen(np.zeros((4, 4))))
    here = analyse(grasp)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    contacts = moved(grasp.contacts, turn * np.sign(np.linalg.det(turn)), rng.normal(size=3))
    there = analyse(replace(grasp, contacts=contacts, G=grasp_matrix(contacts)))
    big = tuple(replace(contact, point=frozen(1e3 * contact.point)) for contact in grasp.contacts)
    units = {"J": frozen(1e3 * grasp.J), "C_s": frozen(1e3 * grasp.C_s)}
    large = analyse(replace(grasp, contacts=big, G=grasp_matrix(big), **units))
    force = here.response.dlambda_dzr
    for other in (there, large):
        assert other.spaces.dimensions == here.spaces.dimensions
        assert size(other.response.dlambda_dzr - force) < 1e-9 * size(force)
    lengths = [np.linalg.norm(each.response.scale.twist(each.response.du_dzr.T), axis=1) for each in (here, there)]
    assert np.allclose(*lengths, rtol=1e-9, atol=1e-12 * size(lengths[0]))


@pytest.mark.parametrize("form", FORMS)
def test_a_load_on_what_is_free_is_refused_to_the_rank_tolerance(form: str) -> None:
    rng = np.random.default_rng(3)
    grasp = free_grasp(rng, form)
    response, load = respond(grasp), unloaded(rng, grasp)[0]
    scale = response.scale
    along = scale.motion.T @ response.free[:, 0] * np.linalg.norm(scale.wrench(load))
    respond(grasp, load + 1e-9 * along)
    with pytest.raises(NotRestrainedError, match="no contact force can balance") as caught:
        respond(grasp, load + 1e-7 * along)
    assert np.allclose(caught.value.unsupported, 1e-7 * along, rtol=1e-6, atol=1e-10 * size(load))
    with pytest.raises(NotRestrainedError):
        respond(replace(grasp, w_0=frozen(along)))
    assert analyse(replace(grasp, w_0=frozen(along)), NO_LOAD).spaces.dimensions == analyse(grasp).spaces.dimensions


@pytest.mark.parametrize("form", FORMS)
def test_many_at_once_are_as_one_by_one(form: str) -> None:
    """Among restrained grasps of the same form, which stand in groups of their own."""
    grasps = [free_grasp(np.random.default_rng(seed), form) for seed in range(12)]
    grasps += [held_by_all(np.random.default_rng(seed), grasps[seed]) for seed in range(12)]
    together = analyse_many(grasps)
    assert not together.refusals
    assert sorted(np.concatenate([group.places for group in together.groups])) == list(range(24))
    for group in together.groups:
        assert len(set(group.response.restraint.ranks)) == 1
    for place, grasp in enumerate(grasps):
        ours, theirs = together.at(place), analyse(grasp)
        assert ours.response.restraint.rank == theirs.response.restraint.rank
        for kind, one, other in ((Maps, ours.response, theirs.response), (Bases, ours.spaces, theirs.spaces)):
            for name in kind.__dataclass_fields__:
                mine, true = getattr(one, name), getattr(other, name)
                assert mine.shape == true.shape
                assert size(mine - true) <= 1e-9 * size(true) + 1e-15, (place, name)  # some are 0 but for rounding


def held_by_all(rng: np.random.Generator, grasp: Grasp) -> Grasp:
    """The same form with contacts that leave nothing free, where there are enough of them."""
    if grasp.n_l < 7 and len(grasp.contacts) < 6:
        return grasp
    contacts = tuple(
        replace(
            contact, point=frozen(0.04 * rng.normal(size=3)), frame=frozen(np.linalg.qr(rng.normal(size=(3, 3)))[0])
        )
        for contact in grasp.contacts
    )
    return replace(grasp, contacts=contacts, G=grasp_matrix(contacts), C_s=compliance(rng, grasp.n_l, 1e-3, "full"))
