import json
import time
from pathlib import Path

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.grasps.matrices import read_matrices

INTACT = Path(__file__).parent.parent / "data" / "bad_inputs" / "grasp.json"


@pytest.fixture
def data():
    return json.loads(INTACT.read_text(encoding="utf-8"))


@pytest.fixture
def read(tmp_path):
    def written(data):
        path = tmp_path / "grasp.json"
        path.write_text(json.dumps(data), encoding="utf-8")
        return read_matrices(path)

    return written


def issues(call, *args):
    with pytest.raises(InputError) as caught:
        call(*args)
    return [(issue.key, issue.message) for issue in caught.value.issues]


def test_arrays_are_read_only_and_as_written(data, read):
    grasp = read(data)
    for name in ("G", "J", "S", "C_q"):
        assert np.array_equal(getattr(grasp, name), data[name])
        assert not getattr(grasp, name).flags.writeable
    assert grasp.title == "three fingers"
    assert grasp.lambda_0 is None
    assert grasp.w_0 is None
    assert grasp.expect == {}


def test_a_number_is_that_many_times_the_identity(data, read):
    grasp = read(data)
    assert np.array_equal(grasp.C_s, 1e-4 * np.eye(9))
    assert np.array_equal(grasp.C_z, np.zeros((2, 2)))


def test_contacts_of_all_kinds(data, read):
    hard, soft, plain = data["contacts"]
    hard["point_m"] = [1, 2, 3]
    soft |= {"kind": "soft", "spin_friction_m": 0.01}
    plain.pop("friction")
    plain.pop("normal")
    plain |= {"kind": "frictionless"}
    keep = [0, 1, 2, 3, 4, 5, 5, 6]
    data["G"] = [[row[i] for i in keep] for row in data["G"]]
    data["J"] = [data["J"][i] for i in keep]
    one, two, three = read(data).contacts
    assert one.kind == HardFinger(friction=0.8)
    assert np.array_equal(one.point, [1, 2, 3])
    assert np.array_equal(one.normal, [1, 0, 0])
    assert (two.kind, two.point) == (SoftFinger(friction=0.8, spin_friction=0.01), None)
    assert (three.name, three.kind, three.normal) == ("C3", Frictionless(), None)


def test_counts_say_what_they_follow_from(data, read):
    data["contacts"][1] |= {"kind": "soft", "spin_friction_m": 0.01}
    assert ("G", "expected 10 columns, got 9 (n_l = 10 follows from 2 hard and 1 soft contacts)") in issues(read, data)


def test_issues_of_contacts_and_matrices_come_together(data, read):
    data["contacts"][0]["friction"] = -1
    data["G"][2][3] = "x"
    data["C_s"] = -1
    assert [key for key, _ in issues(read, data)] == ["contacts[0].friction", "G[2][3]", "C_s"]


def test_a_slightly_asymmetric_compliance_is_made_symmetric(data, read):
    data["C_q"][0][1] = 1e-12
    C_q = read(data).C_q
    assert np.array_equal(C_q, C_q.T)
    assert C_q[1, 0] == 5e-13


def test_a_compliance_at_the_bound_is_accepted(data, read):
    data |= {"C_s": 1e9, "C_z": [[1e9, 0], [0, 0]]}
    assert read(data).C_s[0, 0] == 1e9
    data |= {"C_s": 1.1e9, "C_q": 1e300, "C_z": [[1.1e9, 0], [0, 0]]}
    assert [key for key, _ in issues(read, data)][:1] == ["C_q"]  # no such number at all
    data |= {"C_q": 2e9}
    found = issues(read, data)
    assert [key for key, _ in found] == ["C_s", "C_q", "C_z"]
    assert all(message.endswith("e+09 is too large") for _, message in found)


def test_semidefinite_is_judged_free_of_units(data, read):
    data["C_z"] = [[1e-9, 2e-3], [2e-3, 1e3]]
    assert issues(read, data)[0][0] == "C_z"
    data["C_z"] = [[1e-9, 1e-3], [1e-3, 1e3]]
    assert read(data).C_z.shape == (2, 2)
    data["C_z"] = [[0, 0], [0, 0]]
    assert not read(data).C_z.any()


def test_the_initial_forces_must_balance_the_initial_wrench(data, read):
    forces = np.arange(9.0)
    data["lambda_0"] = forces.tolist()
    wrench = -np.array(data["G"]) @ forces
    data["w_0"] = wrench.tolist()
    grasp = read(data)
    assert np.array_equal(grasp.lambda_0, forces)
    assert np.array_equal(grasp.w_0, wrench)
    data["w_0"][3] += 1e-3
    assert issues(read, data) == [("w_0", "w_0 = -G lambda_0 does not hold: m_x is off by 0.001 N m")]


def test_forces_that_only_squeeze_balance_no_wrench(data, read):
    null = np.linalg.svd(np.array(data["G"]))[2][-1]
    data |= {"lambda_0": (100 * null).tolist(), "w_0": [0] * 6}
    assert read(data).w_0.shape == (6,)


def test_more_synergies_than_joints_are_allowed(data, read):
    data["S"] = [[1.0] * 5 for _ in range(3)]
    assert read(data).C_z.shape == (5, 5)


def test_a_flood_of_wrong_entries_is_cut(data, read):
    data["J"] = [["x"] * 30 for _ in range(9)]
    assert 20 <= len(issues(read, data)) <= 50


def test_a_hand_of_twenty_joints_is_read_quickly(data, tmp_path):
    chance = np.random.default_rng(0)
    data["contacts"] = [{"name": f"C{i}", "kind": "hard", "friction": 1, "normal": [0, 0, 1]} for i in range(9)]
    data |= {"G": chance.normal(size=(6, 27)).tolist(), "J": chance.normal(size=(27, 20)).tolist()}
    data |= {"S": chance.normal(size=(20, 6)).tolist(), "C_s": np.eye(27).tolist(), "C_q": 0.1}
    path = tmp_path / "grasp.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    read_matrices(path)
    start = time.perf_counter()
    for _ in range(5):
        read_matrices(path)
    assert (time.perf_counter() - start) / 5 < 0.1
