"""Arithmetic in twice the precision against exact fractions."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from synergrip.doubled import ROUNDOFF, Doubled, block, solve


def numbers(rng: np.random.Generator, *shape: int) -> Doubled:
    """Numbers of very different sizes with digits in both halves."""
    high = rng.normal(size=shape) * 10.0 ** rng.integers(-6, 6, shape)
    return Doubled(high, high * rng.uniform(-1, 1, shape) * 2.0**-54)


def exact(values: Doubled) -> np.ndarray:
    pairs = zip(values.high.ravel(), values.low.ravel(), strict=True)
    return np.array([Fraction(float(h)) + Fraction(float(low)) for h, low in pairs]).reshape(values.high.shape)


def worst(found: Doubled, true: np.ndarray, size: np.ndarray) -> float:
    return max(float(e / s) for e, s in zip(np.abs(exact(found) - true).ravel(), size.ravel(), strict=True))


@pytest.mark.parametrize("seed", range(5))
def test_operations_are_right_to_their_roundoff(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = numbers(rng, 8, 5), numbers(rng, 8, 5)
    x, y = exact(a), exact(b)
    assert worst(a + b, x + y, np.abs(x) + np.abs(y)) < ROUNDOFF
    assert worst(a - b, x - y, np.abs(x) + np.abs(y)) < ROUNDOFF
    assert worst(a * b, x * y, np.abs(x * y)) < ROUNDOFF
    assert worst(a / b, x / y, np.abs(x / y)) < ROUNDOFF
    assert np.all(np.abs((a * b).low) <= np.spacing(np.abs((a * b).high)) / 2)


@pytest.mark.parametrize("inner", [0, 1, 2, 7, 12])
def test_matrix_products_are_right_to_their_roundoff(inner: int) -> None:
    rng = np.random.default_rng(inner)
    a, b = numbers(rng, 3, inner), numbers(rng, inner, 4)
    x, y = exact(a), exact(b)
    true, size = (np.array([[sum(p[i] * q[:, j], Fraction(0)) for j in range(4)] for i in range(3)])
                  for p, q in ((x, y), (np.abs(x), np.abs(y))))  # fmt: skip
    assert worst(a @ b, true, size + Fraction(1, 10**300)) < ROUNDOFF


def test_cancellation_leaves_what_was_in_the_lower_half() -> None:
    one, little = np.ones((1, 1)), np.full((1, 1), 1e-25)
    assert ((Doubled.of(one) + little) - one).high[0, 0] == pytest.approx(1e-25, rel=1e-6)
    third = Doubled.of(one) / Doubled.of(3 * one)
    assert third.low[0, 0] == pytest.approx(float(Fraction(1, 3) - Fraction(1 / 3)), rel=1e-12)


def test_a_system_too_ill_conditioned_for_float64_is_solved() -> None:
    size = 12
    hilbert = 1 / (np.arange(size)[:, None] + np.arange(size) + 1.0)  # condition 2e16
    x = np.arange(1.0, size + 1)[:, None]
    right = Doubled.of(hilbert) @ Doubled.of(x)
    assert np.allclose(solve(Doubled.of(hilbert), right).high, x, rtol=1e-12)
    assert not np.allclose(np.linalg.solve(hilbert, right.high), x, rtol=1e-3)


def test_solving_takes_the_largest_pivot_and_tells_a_singular_matrix() -> None:
    swapped = np.array([[1e-40, 1.0], [1.0, 1.0]])
    found = solve(Doubled.of(swapped), Doubled.of(np.array([[1.0], [2.0]])))
    assert np.allclose(found.high, [[1.0], [1.0]], rtol=1e-15)
    with pytest.raises(np.linalg.LinAlgError):
        solve(Doubled.of(np.ones((2, 2))), Doubled.of(np.eye(2)))


def test_blocks_are_put_together_as_numpy_does() -> None:
    rng = np.random.default_rng(1)
    a, b, c, d = (numbers(rng, *shape) for shape in ((2, 3), (2, 1), (1, 3), (1, 1)))
    found = block([[a, b], [c, d]])
    assert np.array_equal(found.high, np.block([[a.high, b.high], [c.high, d.high]]))
    assert np.array_equal(found.mT.low, np.block([[a.low, b.low], [c.low, d.low]]).T)
