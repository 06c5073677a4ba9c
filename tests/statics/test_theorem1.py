"""Theorem 1 on random grasps: (34) exactly, the round trip of (35), and what the bases promise."""

from __future__ import annotations

import numpy as np
import pytest
from random_grasps import random_grasp

from synergrip.linalg import Decision
from synergrip.statics import coordinates, respond, subspaces
from synergrip.statics.motion import forward
from synergrip.statics.theorem1 import motion_coordinates

CHUNKS = [range(start, start + 100) for start in range(0, 1000, 100)]


def analysed(seed: int):
    rng = np.random.default_rng(seed)
    response = respond(random_grasp(rng, degenerate=seed % 3 == 0))
    spaces = subspaces(response)
    return rng, response, spaces, coordinates(response, spaces)


@pytest.mark.parametrize("seeds", CHUNKS, ids=lambda seeds: f"from{seeds[0]}")
def test_dimensions_add_up_and_the_force_map_agrees(seeds: range) -> None:
    for seed in seeds:
        _, response, spaces, _ = analysed(seed)
        assert sum(spaces.dimensions) == response.grasp.n_z
        # decided by itself, from the force map's own singular values
        own = np.linalg.svd(response.scale.force[:, None] * response.dlambda_dzr, compute_uv=False)
        assert Decision.of(own, float(own[0])).rank == spaces.dimensions[0], seed
        assert not spaces.ambiguous


@pytest.mark.parametrize("seeds", CHUNKS, ids=lambda seeds: f"from{seeds[0]}")
def test_references_and_coordinates_round_trip(seeds: range) -> None:
    for seed in seeds:
        rng, response, _, coords = analysed(seed)
        dz_r = rng.normal(size=(3, response.grasp.n_z))
        back = coords.references(*coords.coordinates(dz_r))
        assert np.abs(back - dz_r).max() < 1e-10 * np.abs(dz_r).max(), seed
        wanted = [rng.normal(size=d) * size for d, size in zip(coords.dimensions, (5.0, 1e-3, 0.1), strict=True)]
        for got, want in zip(coords.coordinates(coords.references(*wanted)), wanted, strict=True):
            assert np.abs(got - want).max(initial=0.0) < 1e-10 * max(np.abs(w).max(initial=0.0) for w in wanted)


@pytest.mark.parametrize("seed", range(0, 60, 3))
def test_forces_are_determined_by_alpha_alone_and_elastic_motion_is_orthogonal(seed: int) -> None:
    rng, response, spaces, coords = analysed(seed)
    alpha, beta, gamma = (rng.normal(size=d) for d in coords.dimensions)
    motion = forward(response, np.zeros(1), coords.references(alpha, beta, gamma)[None], np.zeros((1, 6)))
    forces = spaces.E_s @ alpha
    assert np.allclose(motion.forces[0], forces, rtol=0, atol=1e-9 * max(np.abs(forces).max(initial=0), 1e-6))
    elastic = motion.du[0] - spaces.Gamma_ucs @ beta
    projected, _ = motion_coordinates(response, spaces, elastic)
    size = np.linalg.norm(response.scale.twist(motion.du[0]))
    assert np.abs(projected).max(initial=0.0) < 1e-9 * size


@pytest.mark.parametrize("seed", range(40))
def test_bases_are_what_they_say(seed: int) -> None:
    _, response, spaces, _ = analysed(seed)
    grasp, scale = response.grasp, response.scale
    E = scale.force[:, None] * spaces.E_s
    assert np.allclose(E.T @ E, np.eye(E.shape[1]), atol=1e-12)
    assert np.abs(scale.wrench((grasp.G @ spaces.E_s).T)).max(initial=0.0) < 1e-13
    U = scale.motion @ spaces.Gamma_ucs
    assert np.allclose(U.T @ U, np.eye(U.shape[1]), atol=1e-12)
    JS = grasp.J @ grasp.S
    assert np.abs(JS @ spaces.Gamma_zcs - grasp.G.T @ spaces.Gamma_ucs).max(initial=0.0) < 1e-10
    assert np.abs(JS @ spaces.Gamma_zr).max(initial=0.0) < 1e-12 * np.abs(JS).max()
    forces = response.dlambda_dzr  # E_s spans the range of the force map (29)
    assert np.allclose(
        spaces.E_s @ np.linalg.lstsq(spaces.E_s, forces, rcond=None)[0], forces, atol=1e-9 * np.abs(forces).max()
    )


@pytest.mark.parametrize("seed", range(0, 30, 3))
def test_rigid_motion_costs_no_force(seed: int) -> None:
    _, response, spaces, _ = analysed(seed)
    moved = response.dlambda_dzr @ np.hstack([spaces.Gamma_zcs, spaces.Gamma_zr])
    assert np.abs(moved).max(initial=0.0) < 1e-9 * np.abs(response.dlambda_dzr).max()
    carried = response.du_dzr @ spaces.Gamma_zcs
    assert np.allclose(carried, spaces.Gamma_ucs, atol=1e-9 * max(np.abs(spaces.Gamma_ucs).max(initial=0), 1e-9))
