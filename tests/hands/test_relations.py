import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.hands.relations import Relations, couplings, with_pulls
from synergrip.hands.synergies import coupling_map

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
    with pytest.raises(InputError, match="nearly repeat"):
        with_pulls(Relations(np.zeros((0, 3)), np.zeros(0)), A, np.zeros(3))


def test_contradictions_are_seen_and_repetitions_are_not():
    A = np.array([[1.0, -1, 0], [-3, 3, 0], [0, 0, 1], [0, 0, 0]])
    good = Relations(A, np.array([0.1, -0.3, 2, 0])).scaled()
    q = good.nearest(np.array([5.0, 1, 0]))
    np.testing.assert_allclose(q, [3.05, 2.95, 2])
    np.testing.assert_allclose(good.disagreement(q), 0, atol=1e-14)
    for b in ([0.1, -0.2, 2, 0], [0.1, -0.3, 2, 1]):
        bad = Relations(A, np.array(b)).scaled()
        assert bad.disagreement(bad.nearest(np.zeros(3))).max() > 0.01


@pytest.mark.parametrize("seed", range(20))
def test_pulls_settle_where_equal_springs_are_in_balance(seed):
    """With a spring of stiffness 1 in each joint, q - q_0 is a mix of pulls and of forces of the relations."""
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(1, 7)) * [1, 1, 1, 0, 0, 0, 0]
    pulls = rng.normal(size=(2, 7)) * [0, 1, 1, 1, 1, 0, 0]
    pulls = np.vstack([pulls, np.eye(7)[4] * 3])
    q_0 = rng.normal(size=7)
    b = A @ q_0 + 0.3
    relations = Relations(A, b).scaled()
    found = couplings(NAMES, with_pulls(relations, pulls, q_0), range(7))
    assert len(found) == 2  # joints a to e share actuators or are tied to those that do; three actuators drive them
    assert not {"f", "g"} & set(found)
    E, e = coupling_map(NAMES, found)
    q = E @ rng.normal(size=7) + e
    forces = np.vstack([A, pulls])[:, :5].T
    strain = (q - q_0)[:5]
    assert np.abs(strain - forces @ np.linalg.lstsq(forces, strain, rcond=None)[0]).max() < 1e-12
    np.testing.assert_allclose(A @ q, b, atol=1e-12)


def test_a_tendon_with_one_motor_moves_its_joints_in_proportion():
    nothing = Relations(np.zeros((0, 4)), np.zeros(0))
    found = couplings("abcd", with_pulls(nothing, np.array([[0, 2.0, 0, 3]]), np.array([0, 1.0, 0, 1])), [3, 1, 0, 2])
    assert found["d"].ratios == {"b": 1.5}
    assert found["d"].offset == -0.5
    assert len(found) == 1


def test_as_many_motors_as_joints_leave_every_joint_free():
    nothing = Relations(np.zeros((0, 3)), np.zeros(0))
    pulls = np.array([[1.0, 1, 0], [1, 0, 0]])
    assert couplings("abc", with_pulls(nothing, pulls, np.zeros(3)), [0, 1, 2]) == {}
    assert with_pulls(nothing, np.eye(3), np.zeros(3)) is nothing


def test_an_equality_rules_over_the_proportion_of_a_tendon():
    equal = Relations(np.array([[1.0, -1]]), np.array([0.0])).scaled()
    found = couplings("ab", with_pulls(equal, np.array([[1.0, 2]]), np.zeros(2)), [1, 0])
    assert found["b"].ratios == {"a": 1.0}
