"""The statics of pulls and springs, against the saddle point of the energy, solved as it stands."""

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.hands.models.relations import Relations, couplings
from synergrip.hands.models.settling import Springs, settle
from synergrip.hands.synergies.matrix import coupling_map

NAMES = list("abcdefg")
NOTHING = Relations(np.zeros((0, 3)), np.zeros(0))


def springs(n, **stiffness):
    """Return springs at the named joints of `n`, at rest at 0."""
    F = np.zeros((len(stiffness), n))
    for row, (name, k) in enumerate(stiffness.items()):
        F[row, NAMES.index(name)] = np.sqrt(k)
    return Springs(F, np.zeros(len(stiffness)))


NO_SPRINGS = springs(3)


def ratios(found, drivers):
    """Return how the joints move when one of the drivers moves by 1 and the other ones rest."""
    return found.driven @ np.linalg.inv(found.driven[drivers])


def random_hand(seed, n=7):
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(1, n)) * [1, 1, 1, 0, 0, 0, 0]
    pulls = rng.normal(size=(3, n)) * [0, 1, 1, 1, 1, 0, 0]
    F = rng.normal(size=(n + 1, n)) * 10.0 ** rng.uniform(-2, 2, (n + 1, 1))
    q_0 = rng.normal(size=n)
    return Relations(A, A @ q_0 + 0.3).scaled(), pulls, Springs(F, rng.normal(size=n + 1)), q_0


def balance(relations, pulls, springs, y, torque):
    """Return q of least energy with the pulls at y, under the torque of the contacts (the hand pushes with it)."""
    A, R, F = relations.A, pulls, springs.F
    n, m = F.shape[1], len(A) + len(R)
    held = np.vstack([A, R])
    system = np.block([[F.T @ F, held.T], [held, np.zeros((m, m))]])
    return np.linalg.solve(system, np.concatenate([F.T @ springs.g - torque, relations.b, y]))[:n]


@pytest.mark.parametrize("seed", range(20))
def test_joints_settle_where_springs_motors_and_contacts_balance(seed):
    relations, pulls, held, q_0 = random_hand(seed)
    found = settle(relations, pulls, held, q_0)
    assert not any(found.idle)
    assert found.loose.shape == (7, 0)
    rng = np.random.default_rng(seed + 100)
    y, step, torque = rng.normal(size=3), rng.normal(size=3), rng.normal(size=7)
    q = balance(relations, pulls, held, y, np.zeros(7))
    moved = balance(relations, pulls, held, y + step, np.zeros(7)) - q
    span = found.driven @ np.linalg.lstsq(found.driven, moved, rcond=None)[0]
    np.testing.assert_allclose(span, moved, atol=1e-9 * np.abs(moved).max())
    yielded = balance(relations, pulls, held, y, torque) - q
    np.testing.assert_allclose(yielded, -found.compliance @ torque, atol=1e-8 * np.abs(yielded).max())
    rest = found.rest + found.driven @ np.linalg.lstsq(found.driven, q - found.rest, rcond=None)[0]
    np.testing.assert_allclose(rest, q, atol=1e-8 * max(np.abs(q).max(), 1))


@pytest.mark.parametrize("seed", range(5))
def test_followers_stand_where_the_balance_is(seed):
    relations, pulls, held, q_0 = random_hand(seed)
    found = settle(relations, pulls, held, q_0)
    followers = couplings(NAMES, found.relations, range(7))
    assert len(followers) == 4
    E, e = coupling_map(NAMES, followers)
    q = balance(relations, pulls, held, np.array([0.3, -0.2, 0.7]), np.zeros(7))
    np.testing.assert_allclose(E @ q + e, q, atol=1e-8)


def test_one_motor_on_a_tendon_bends_the_softer_joint_more():
    arms, compliance = np.array([2.0, 3.0]), np.array([0.5, 4.0])
    found = settle(Relations(np.zeros((0, 2)), np.zeros(0)), arms[None], springs(2, a=1 / 0.5, b=1 / 4.0), np.zeros(2))
    along = compliance * arms
    np.testing.assert_allclose(ratios(found, [0])[:, 0], along / along[0])
    expected = np.diag(compliance) - np.outer(along, along) / (arms @ along)
    np.testing.assert_allclose(found.compliance, expected, atol=1e-14)
    np.testing.assert_allclose(arms @ found.compliance, 0, atol=1e-14)  # a stiff motor holds the tendon


def test_a_joint_without_a_spring_bends_first():
    found = settle(NOTHING, np.array([[1.0, 0.5, 0]]), springs(3, a=0.2), np.zeros(3))
    np.testing.assert_allclose(ratios(found, [1])[:, 0], [0, 1, 0], atol=1e-14)
    assert found.idle == (False, False, True)  # the first is pushed at, and is no joint that nothing drives
    n = np.array([0.5, -1.0, 0]) / np.sqrt(1.25)
    np.testing.assert_allclose(found.compliance, np.outer(n, n) / (0.2 * n[0] ** 2), atol=1e-13)


def test_springs_of_very_different_size_keep_their_digits():
    soft, stiff = 1e-4, 1e6
    found = settle(NOTHING, np.zeros((0, 3)), springs(3, a=soft, b=stiff, c=1.0), np.zeros(3))
    np.testing.assert_allclose(np.diag(found.compliance), [1 / soft, 1 / stiff, 1.0], rtol=1e-9)
    assert all(found.idle)


def test_joints_that_nothing_drives_are_told_from_those_that_nothing_holds():
    found = settle(NOTHING, np.array([[1.0, 0, 0]]), Springs(np.array([[0, 2.0, 0]]), np.array([0.8])), np.ones(3))
    assert found.idle == (False, True, True)
    np.testing.assert_allclose(found.rest, [1, 0.4, 1])
    np.testing.assert_allclose(np.abs(found.loose[:, 0]), [0, 0, 1], atol=1e-15)
    np.testing.assert_allclose(found.compliance, np.diag([0, 0.25, 0]), atol=1e-15)
    assert found.relations is None  # nothing follows anything


def test_a_spring_between_a_driven_joint_and_another_one_drives_that():
    between = Springs(np.array([[1.0, -2.0, 0]]), np.zeros(1))
    found = settle(NOTHING, np.array([[1.0, 0, 0]]), between, np.zeros(3))
    assert found.idle == (False, False, True)
    np.testing.assert_allclose(ratios(found, [0])[:, 0], [1, 0.5, 0], atol=1e-14)


@pytest.mark.parametrize("seed", range(20))
def test_without_springs_joints_yield_alike(seed):
    """As with a spring of stiffness 1 in each: q - q_0 is a mix of pulls and of forces of the relations."""
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(1, 7)) * [1, 1, 1, 0, 0, 0, 0]
    pulls = rng.normal(size=(2, 7)) * [0, 1, 1, 1, 1, 0, 0]
    pulls = np.vstack([pulls, np.eye(7)[4] * 3, np.eye(7)[5:]])
    q_0 = rng.normal(size=7)
    relations = Relations(A, A @ q_0 + 0.3).scaled()
    found = settle(relations, pulls, springs(7), q_0)
    followers = couplings(NAMES, found.relations, range(7))
    assert len(followers) == 2  # three actuators drive the joints a to e, which are tied to each other
    assert not {"f", "g"} & set(followers)
    E, e = coupling_map(NAMES, followers)
    q = E @ rng.normal(size=7) + e
    forces = np.vstack([A, pulls])[:, :5].T
    strain = (q - q_0)[:5]
    assert np.abs(strain - forces @ np.linalg.lstsq(forces, strain, rcond=None)[0]).max() < 1e-12
    np.testing.assert_allclose(A @ q, relations.b * np.linalg.norm(A), atol=1e-12)
    np.testing.assert_array_equal(found.compliance, np.zeros((7, 7)))


def test_a_tendon_with_one_motor_moves_joints_without_springs_in_proportion():
    found = settle(
        Relations(np.zeros((0, 4)), np.zeros(0)), np.array([[0, 2.0, 0, 3]]), springs(4), np.array([0, 1.0, 0, 1])
    )
    followers = couplings("abcd", found.relations, [3, 1, 0, 2])
    assert followers["d"].ratios == {"b": 1.5}
    assert followers["d"].offset == -0.5
    assert len(followers) == 1


def test_as_many_motors_as_joints_leave_every_joint_free():
    for pulls in (np.array([[1.0, 1, 0], [1, 0, 0]]), np.eye(3)):
        assert settle(NOTHING, pulls, NO_SPRINGS, np.zeros(3)).relations is None


def test_an_equality_rules_over_the_proportion_of_a_tendon():
    equal = Relations(np.array([[1.0, -1]]), np.array([0.0])).scaled()
    found = settle(equal, np.array([[1.0, 2]]), springs(2), np.zeros(2))
    assert found.relations is None
    np.testing.assert_allclose(ratios(found, [0])[:, 0], [1, 1])


def test_pulls_that_nearly_repeat_each_other_are_refused():
    with pytest.raises(InputError, match="nearly repeat"):
        settle(NOTHING, np.array([[1.0, -1, 0], [1, -1 + 1e-7, 0]]), NO_SPRINGS, np.zeros(3))
