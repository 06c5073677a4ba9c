import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.hands.models.relations import Relations, couplings
from synergrip.hands.synergies.matrix import coupling_map

NAMES = list("abcdefg")


def related(rng, rows, columns=7):
    """Return relations that hold at a known place, more than half of them repeated."""
    A = rng.normal(size=(rows, columns)) * (rng.random((rows, columns)) < 0.6)
    mixed = rng.normal(size=(rows + 2, rows)) @ A
    return Relations(mixed, mixed @ rng.normal(size=columns)).scaled()


@pytest.mark.parametrize("seed", range(20))
def test_followers_obey_the_relations_whatever_the_free_joints_do(seed):
    rng = np.random.default_rng(seed)
    relations = related(rng, int(rng.integers(1, 5)))
    found = couplings(NAMES, relations, rng.permutation(7))
    assert len(found) == np.linalg.matrix_rank(relations.A)
    E, e = coupling_map(NAMES, found)
    for _ in range(3):
        np.testing.assert_allclose(relations.A @ (E @ rng.normal(size=7) + e), relations.b, atol=1e-10)
    assert not {driver for each in found.values() for driver in each.ratios} & set(found)


def test_the_order_says_who_follows():
    relations = Relations(np.array([[2.0, 0, -1]]), np.array([0.5])).scaled()
    assert couplings("abc", relations, [0, 2, 1])["a"].ratios == {"c": 0.5}
    assert couplings("abc", relations, [1, 2, 0])["c"].ratios == {"a": 2.0}
    assert couplings("abc", relations, [1, 2, 0])["c"].offset == -0.5


def test_a_joint_alone_in_a_relation_is_locked():
    relations = Relations(np.array([[0.0, 4, 0]]), np.array([2.0])).scaled()
    found = couplings("abc", relations, [0, 1, 2])
    assert list(found) == ["b"]
    assert (dict(found["b"].ratios), found["b"].offset) == ({}, 0.5)


def test_relations_that_nearly_repeat_each_other_are_refused():
    A = np.array([[1.0, -1, 0], [1, -1 + 1e-7, 0]])
    with pytest.raises(InputError, match="nearly repeat"):
        Relations(A, np.zeros(2)).scaled().nearest(np.zeros(3))


def test_contradictions_are_seen_and_repetitions_are_not():
    A = np.array([[1.0, -1, 0], [-3, 3, 0], [0, 0, 1], [0, 0, 0]])
    good = Relations(A, np.array([0.1, -0.3, 2, 0])).scaled()
    q = good.nearest(np.array([5.0, 1, 0]))
    np.testing.assert_allclose(q, [3.05, 2.95, 2])
    np.testing.assert_allclose(good.disagreement(q), 0, atol=1e-14)
    for b in ([0.1, -0.2, 2, 0], [0.1, -0.3, 2, 1]):
        bad = Relations(A, np.array(b)).scaled()
        assert bad.disagreement(bad.nearest(np.zeros(3))).max() > 0.01
