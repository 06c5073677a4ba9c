"""The inverse by factors that stacks of grasps are answered with, and what happens where it is not good enough."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest
from random_grasps import random_grasp

import synergrip.statics.responses as responses_module
from synergrip.grasps.scale import Metric
from synergrip.grasps.stack import Matrices
from synergrip.linalg import Array
from synergrip.statics.factors import inverse_by_factors
from synergrip.statics.response import Maps
from synergrip.statics.responses import respond_many
from synergrip.statics.saddle import FLOAT64, STACKED, Arithmetic
from synergrip.statics.yielding import smallest_of_unit_diagonal


@pytest.mark.parametrize("size", [1, 5, 8, 9, 16, 27])
def test_inverses_by_factors(size: int) -> None:
    """Blocks of any size, and units of rows ten decades up and down."""
    rng = np.random.default_rng(size)
    root, G = rng.normal(size=(7, size, size)), rng.normal(size=(7, min(size, 6), size))
    C = root @ root.mT + np.eye(size)
    whole = np.block([[C, G.mT], [G, np.zeros((7, len(G[0]), len(G[0])))]])
    true = np.linalg.inv(whole)
    assert np.allclose(inverse_by_factors(C, G), true, rtol=0, atol=1e-11 * np.abs(true).max())
    units = 10.0 ** rng.integers(-10, 11, size=len(whole[0]))
    scaled = whole * np.outer(units, units)
    found = inverse_by_factors(scaled[:, :size, :size], scaled[:, size:, :size]) * np.outer(units, units)
    assert np.allclose(found, true, rtol=0, atol=1e-11 * np.abs(true).max())
    with pytest.raises(np.linalg.LinAlgError):
        inverse_by_factors(-C, G)


@pytest.mark.parametrize("agreed", [0.0, 1e-12])
def test_what_factors_lose_too_much_of_is_answered_as_alone(agreed: float, monkeypatch: pytest.MonkeyPatch) -> None:
    grasps = [random_grasp(np.random.default_rng(3), ["soft"] * 4, n_q=8, n_z=4)] * 6
    used, right = [], responses_module.maps_in_float64

    def noting(matrices: Matrices, metric: Metric, arithmetic: Arithmetic[Array] = FLOAT64) -> object:
        used.append((arithmetic is STACKED, len(matrices.G)))
        return right(matrices, metric, arithmetic)

    monkeypatch.setattr(responses_module, "maps_in_float64", noting)
    monkeypatch.setattr(responses_module, "AGREED", agreed)
    found = respond_many(grasps)
    assert used == ([(True, 6)] if agreed == 1e-12 else [(True, 6), (False, 6)])
    assert len(found.one_by_one) == 0
    assert found.places.tolist() == list(range(6))


def test_one_matrix_without_factors_sends_no_grasp_away(monkeypatch: pytest.MonkeyPatch) -> None:
    grasps = [random_grasp(np.random.default_rng(3), ["soft"] * 4, n_q=8, n_z=4)] * 6
    right = responses_module.maps_in_float64

    def refusing(matrices: Matrices, metric: Metric, arithmetic: Arithmetic[Array] = FLOAT64) -> object:
        if arithmetic is STACKED:
            raise np.linalg.LinAlgError("Matrix is not positive definite")
        return right(matrices, metric, arithmetic)

    monkeypatch.setattr(responses_module, "maps_in_float64", refusing)
    assert len(respond_many(grasps).one_by_one) == 0


def test_chunks_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    kinds = ["hard", "soft", "frictionless", "soft"]
    grasps = [random_grasp(np.random.default_rng(seed), kinds, n_q=6, n_z=4) for seed in range(30)]
    whole = respond_many(grasps)
    for name, few in (("CHUNK", 7), ("ENTRIES", 2000)):
        monkeypatch.setattr(responses_module, name, few)
        pieces = respond_many(grasps)
        for field in fields(Maps):
            ours, theirs = getattr(pieces, field.name), getattr(whole, field.name)
            assert np.allclose(ours, theirs, rtol=0, atol=1e-12 * np.abs(theirs).max()), field.name


@pytest.mark.parametrize("size", [1, 2, 6, 16])
def test_the_bound_that_spares_singular_values_is_one(size: int) -> None:
    """Never above the smallest eigenvalue; close to it where that is small and alone; 0 where there is no factor."""
    rng = np.random.default_rng(size)
    vectors = np.linalg.qr(rng.normal(size=(200, size, size)))[0]
    values = np.concatenate([10.0 ** rng.uniform(-12, 0, size=(200, 1)), np.ones((200, size - 1))], axis=1)
    stack = (vectors * values[:, None]) @ vectors.mT
    units = 10.0 ** rng.uniform(-5, 5, size=(200, size, 1))
    root = 1 / np.sqrt(np.diagonal(stack, axis1=1, axis2=2))[:, :, None]
    least = np.linalg.eigvalsh(stack * root * root.mT)[:, 0]
    found = smallest_of_unit_diagonal(stack * units * units.mT)
    assert np.all(found <= least * (1 + 1e-9) + 1e-14)
    assert np.all(found >= least / (3 * np.e) - 1e-14)
    stack[7] *= -1
    broken = smallest_of_unit_diagonal(stack)
    assert broken[7] == 0.0
    assert np.allclose(np.delete(broken, 7), np.delete(found, 7), rtol=1e-3, atol=1e-14)
