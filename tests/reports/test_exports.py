"""Exports read back by programs that are not ours, and compared with plan.json.

The readers: the csv module, NumPy, pyarrow, PyYAML, rosbags, and MuJoCo, whose bodies stand where another reader of the
URDF file has them.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal

import numpy as np
import pytest
import yaml
from executing_program import Tree
from pydantic import BaseModel, ConfigDict, Field
from scipy.spatial.transform import Rotation

import synergrip as sg
from synergrip.reports.data.exports.exporting import EXPORTERS

REPOSITORY = Path(__file__).parents[2]
CLOSE: dict[str, float] = {"rtol": 0.0, "atol": 1e-9}
OF_HANDS = ["isaac_grasp", "moveit_grasp", "mjcf"]


def planned(name: str, folder: Path, *overrides: str) -> SimpleNamespace:
    """Return a plan in all the formats that it has, and plan.json beside it."""
    problem = sg.load_problem(name, overrides=list(overrides))
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Plan)
    answer.save(folder, formats="json")
    document = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
    to = list(EXPORTERS) if "execution" in document else [each for each in EXPORTERS if each not in OF_HANDS]
    files = sg.export(folder, folder / "export", to=to)
    assert sorted(files) == sorted((folder / "export").iterdir())
    return SimpleNamespace(answer=answer, plan=document, folder=folder / "export")


@pytest.fixture(scope="module")
def moved(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """A gripper that moves a box while its palm turns; its pads roll."""
    found = planned("gripper-box", tmp_path_factory.mktemp("moved"), "task.knots=5")
    assert found.plan["true"]["contact_model"] == "rolling"
    return found


@pytest.fixture(scope="module")
def given(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """A grasp given as matrices."""
    return planned("tripod", tmp_path_factory.mktemp("given"))


def columns(found: SimpleNamespace) -> dict[str, np.ndarray]:
    with (found.folder / "trajectory.csv").open(encoding="utf-8", newline="") as stream:
        header, *lines = csv.reader(stream)
    assert len(set(header)) == len(header)
    return dict(zip(header, np.array(lines, dtype=float).T, strict=True))


def true_values(found: SimpleNamespace) -> dict[str, Any]:
    """What columns of a plan of the gripper must hold, by plan.json alone."""
    plan, true, told = found.plan, found.plan["true"], found.plan["execution"]
    expected: dict[str, Any] = {"t_s": plan["time_s"]}

    def put(key: str, names: list[str], values: Any) -> None:
        for name, column in zip(names, np.transpose(values), strict=True):
            expected[f"{key}_{name}"] = column

    rows = [f"{name}_{row}" for name in plan["contacts"] for row in ("n_N", "t_N", "o_N", "m_Nm")]
    motion = ["x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad"]
    put("zr", [f"{name}_rad" for name in plan["synergies"]], plan["dz_r"])
    put("true_q", [f"{name}_rad" for name in plan["joints"]], true["q"])
    put("true_tau", [f"{name}_Nm" for name in plan["joints"]], plan["tau"])
    put("true_lambda", rows, true["lambda"])
    put("true_du", motion, true["du"])
    put("true_object", motion[:3], np.array(told["object"]["position_m"]) + np.array(true["du"])[:, :3])
    put("true_margin", [f"{name}_N" for name in plan["contacts"]], true["margin"]["per_contact_N"])
    put("wrench", ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"], plan["wrench"])
    return expected


def test_csv_holds_the_true_equilibria_with_units_in_its_names(moved: SimpleNamespace) -> None:
    found, expected = columns(moved), true_values(moved)
    others = {name for name in found if name not in expected}
    assert others == {f"qr_{name}_rad" for name in moved.plan["joints"]} | {
        f"true_object_quaternion_{axis}" for axis in "wxyz"
    }
    for name, values in expected.items():
        np.testing.assert_allclose(found[name], values, **CLOSE, err_msg=name)
    quaternion = np.column_stack([found[f"true_object_quaternion_{axis}"] for axis in "xyzw"])
    turned = Rotation.from_quat(quaternion).as_rotvec()
    np.testing.assert_allclose(turned, np.array(moved.plan["true"]["du"])[:, 3:], **CLOSE)


def test_joints_sent_to_their_references_come_to_where_they_are(moved: SimpleNamespace) -> None:
    """A position controller of the compliance C at qr carries tau = C^-1 (qr - q), the torque of the plan."""
    found, told = columns(moved), moved.plan["execution"]
    C = np.array(told["C_q"]) + np.array(told["S"]) @ np.array(told["C_z"]) @ np.array(told["S"]).T
    gaps = np.column_stack([found[f"qr_{name}_rad"] - found[f"true_q_{name}_rad"] for name in moved.plan["joints"]])
    np.testing.assert_allclose(np.linalg.solve(C, gaps.T).T, moved.plan["tau"], rtol=0, atol=1e-8)
    assert np.abs(gaps).max() > 1e-4


def test_csv_of_matrices_says_of_nothing_that_it_is_true(given: SimpleNamespace) -> None:
    found, plan = columns(given), given.plan
    assert not [name for name in found if name.startswith("true")]
    for key, names, values in (
        ("zr", plan["synergies"], plan["dz_r"]),
        ("dq", [f"{name}_rad" for name in plan["joints"]], plan["dq"]),
        ("tau", [f"{name}_Nm" for name in plan["joints"]], plan["tau"]),
        ("lambda", [f"{name}_{row}_N" for name in plan["contacts"] for row in "nto"], plan["lambda"]),
        ("margin", [f"{name}_N" for name in plan["contacts"]], plan["margin"]["per_contact_N"]),
    ):
        for name, column in zip(names, np.transpose(values), strict=True):
            np.testing.assert_allclose(found[f"{key}_{name}"], column, **CLOSE, err_msg=f"{key} {name}")


@pytest.mark.parametrize("which", ["moved", "given"])
def test_npz_and_parquet_hold_what_csv_holds(which: str, request: pytest.FixtureRequest) -> None:
    import pyarrow.parquet as pq

    found = request.getfixturevalue(which)
    expected, seen = columns(found), {"t_s"}
    with np.load(found.folder / "trajectory.npz", allow_pickle=False) as archive:
        assert json.loads(str(archive["about"])) == json.loads(pq.read_metadata(
            found.folder / "trajectory.parquet").metadata[b"about"])  # fmt: skip
        np.testing.assert_array_equal(archive["time_s"], expected["t_s"])
        for key in {*archive} - {"about", "time_s"}:
            if not key.endswith("_names"):
                unit = key.rpartition("_")[2] if key.rpartition("_")[2] in ("rad", "m", "N", "Nm") else ""
                for name, column in zip(archive[f"{key}_names"], archive[key].T, strict=True):
                    whole = f"{key.removesuffix(f'_{unit}')}_{name}_{unit}".rstrip("_")
                    np.testing.assert_array_equal(column, expected[whole], err_msg=whole)
                    seen.add(whole)
    assert seen == set(expected)
    table = pq.read_table(found.folder / "trajectory.parquet")
    assert table.column_names == list(expected)
    for name, column in expected.items():
        np.testing.assert_array_equal(table[name].to_numpy(), column)
        assert table.schema.field(name).metadata[b"meaning"]


def test_a_file_says_what_its_figures_are(moved: SimpleNamespace, given: SimpleNamespace) -> None:
    for found, word in ((moved, "true equilibria"), (given, "linear model")):
        with np.load(found.folder / "trajectory.npz") as archive:
            about = json.loads(str(archive["about"]))
        assert word in about["figures"]
        assert about["plan_sha256"] == found.plan["digest"]["sha256"]
        assert about["title"] == found.plan["title"]
        assert word in (found.folder / "synergies.yaml").read_text(encoding="utf-8")


def messages(found: SimpleNamespace) -> dict[str, Any]:
    """The messages of the bag, by topic."""
    from rosbags.rosbag2 import Reader
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    with Reader(found.folder) as reader:
        return {
            connection.topic.removeprefix("/"): store.deserialize_cdr(raw, connection.msgtype)
            for connection, _, raw in reader.messages()
        }


@pytest.mark.parametrize("of", ["yaml", "mcap"])
def test_trajectories_of_joints_and_synergies_come_back(moved: SimpleNamespace, of: str) -> None:
    plan, found = moved.plan, columns(moved)
    references = np.column_stack([found[f"qr_{name}_rad"] for name in plan["joints"]])
    expected = {
        "joints": (plan["joints"], plan["true"]["q"], plan["tau"]),
        "joint_references": (plan["joints"], references, None),
        "synergies": (plan["synergies"], plan["dz_r"], None),
    }
    bag = messages(moved) if of == "mcap" else None
    assert bag is None or bag.keys() == expected.keys()
    for name, (names, positions, efforts) in expected.items():
        message = bag[name] if bag else as_object(yaml.safe_load((moved.folder / f"{name}.yaml").read_text("utf-8")))
        assert message.joint_names == names
        assert message.header.frame_id == ""
        assert len(message.points) == len(plan["time_s"])
        for k, point in enumerate(message.points):
            np.testing.assert_allclose(point.positions, positions[k], **CLOSE)
            np.testing.assert_allclose(point.effort, [] if efforts is None else efforts[k], **CLOSE)
            assert len(point.velocities) == len(point.accelerations) == 0
            time = point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec
            assert time == pytest.approx(plan["time_s"][k], abs=1e-9)


def test_of_matrices_the_synergies_alone_are_sent(given: SimpleNamespace) -> None:
    (message,) = messages(given).values()
    assert message.joint_names == given.plan["synergies"]
    np.testing.assert_allclose([point.positions for point in message.points], given.plan["dz_r"], **CLOSE)
    assert {"synergies.yaml"} == {path.name for path in given.folder.glob("*.yaml")} - {"metadata.yaml"}


def as_object(value: Any) -> Any:
    if isinstance(value, Mapping):
        return SimpleNamespace(**{key: as_object(each) for key, each in value.items()})
    return [as_object(each) for each in value] if isinstance(value, list) else value


class Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class Turn(Strict):
    w: float
    xyz: list[float] = Field(min_length=3, max_length=3)


class IsaacGrasp(Strict):
    confidence: float | None = Field(ge=0, le=1)
    position: list[float] = Field(min_length=3, max_length=3)
    orientation: Turn
    cspace_position: dict[str, float]
    pregrasp_cspace_position: dict[str, float]


class IsaacFile(Strict):
    """isaac_grasp 1.0."""

    format: Literal["isaac_grasp"]
    format_version: Literal[1.0]
    object_frame: str
    object_frame_link: str
    gripper_frame: str
    gripper_frame_link: str
    grasps: dict[str, IsaacGrasp] = Field(min_length=1)


def test_isaac_grasp_keeps_its_schema_and_the_palm_where_it_is(moved: SimpleNamespace) -> None:
    file = IsaacFile.model_validate(yaml.safe_load((moved.folder / "isaac_grasp.yaml").read_text("utf-8")))
    true, told = moved.plan["true"], moved.plan["execution"]
    assert list(file.grasps) == ["first_knot", "last_knot"]
    assert file.gripper_frame == told["root_link"]
    for grasp, k in zip(file.grasps.values(), (0, -1), strict=True):
        assert grasp.confidence is None
        assert grasp.pregrasp_cspace_position == {}
        assert list(grasp.cspace_position) == moved.plan["joints"]
        np.testing.assert_allclose(list(grasp.cspace_position.values()), true["q"][k], **CLOSE)
        palm = Rotation.from_quat([*grasp.orientation.xyz, grasp.orientation.w])  # in the frame of the object
        turned = Rotation.from_rotvec(true["du"][k][3:])
        place = np.array(told["object"]["position_m"]) + true["du"][k][:3]
        assert (turned * palm).magnitude() == pytest.approx(0, abs=1e-9)
        np.testing.assert_allclose(place + turned.apply(grasp.position), 0, **CLOSE)  # the palm is the origin


GRASP = """string id
trajectory_msgs/JointTrajectory pre_grasp_posture
trajectory_msgs/JointTrajectory grasp_posture
geometry_msgs/PoseStamped grasp_pose
float64 grasp_quality
moveit_msgs/GripperTranslation pre_grasp_approach
moveit_msgs/GripperTranslation post_grasp_retreat
moveit_msgs/GripperTranslation post_place_retreat
float32 max_contact_force
string[] allowed_touch_objects
"""
TRANSLATION = "geometry_msgs/Vector3Stamped direction\nfloat32 desired_distance\nfloat32 min_distance\n"
"""Names and types of the fields of moveit_msgs, in their order (the package is BSD-3-Clause)."""


def test_moveit_grasp_is_a_message_with_posture_and_efforts(moved: SimpleNamespace) -> None:
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    for name, text in (("GripperTranslation", TRANSLATION), ("Grasp", GRASP)):
        store.register(get_types_from_msg(text, f"moveit_msgs/msg/{name}"))
    document = yaml.safe_load((moved.folder / "moveit_grasp.yaml").read_text("utf-8"))
    made = message_of(store, "moveit_msgs/msg/Grasp", document)  # every field, and no other
    back = store.deserialize_cdr(store.serialize_cdr(made, "moveit_msgs/msg/Grasp"), "moveit_msgs/msg/Grasp")
    plan, true = moved.plan, moved.plan["true"]
    (point,) = back.grasp_posture.points
    assert back.grasp_posture.joint_names == plan["joints"]
    np.testing.assert_allclose(point.positions, true["q"][0], **CLOSE)
    np.testing.assert_allclose(point.effort, plan["tau"][0], **CLOSE)
    forces = np.array(true["lambda"]).reshape(len(plan["time_s"]), -1, 4)[:, :, :3]  # the last is a moment
    largest = np.linalg.norm(forces, axis=2).max()
    assert document["max_contact_force"] == pytest.approx(largest, abs=1e-9)
    assert back.max_contact_force == pytest.approx(largest, rel=1e-6)  # 32 bits
    assert back.grasp_quality == 0
    assert not back.pre_grasp_posture.points
    place, turn = back.grasp_pose.pose.position, back.grasp_pose.pose.orientation
    turned = Rotation.from_rotvec(true["du"][0][3:])
    at = np.array(plan["execution"]["object"]["position_m"]) + true["du"][0][:3]
    np.testing.assert_allclose(at + turned.apply([place.x, place.y, place.z]), 0, **CLOSE)
    assert (turned * Rotation.from_quat([turn.x, turn.y, turn.z, turn.w])).magnitude() == pytest.approx(0, abs=1e-9)


def message_of(store: Any, name: str, fields: Any) -> Any:
    """Return a message of the fields of a document, which are those of its definition."""
    from rosbags.interfaces import Nodetype

    kind, definition = store.types[name], dict(store.get_msgdef(name).fields)
    assert fields.keys() == definition.keys()

    def value(node: Any, given: Any) -> Any:
        if node[0] == Nodetype.NAME:
            return message_of(store, node[1], given)
        if node[0] == Nodetype.SEQUENCE:
            inner = node[1][0]
            if inner == (Nodetype.BASE, ("float64", 0)):
                return np.array(given, dtype=float)
            return [value(inner, each) for each in given]
        return given

    return kind(**{key: value(node, fields[key]) for key, node in definition.items()})


def test_the_keyframes_of_mjcf_put_the_hand_and_the_object_where_they_are(moved: SimpleNamespace) -> None:
    import mujoco

    plan, true, told = moved.plan, moved.plan["true"], moved.plan["execution"]
    model = mujoco.MjModel.from_xml_path(str(moved.folder / "keyframes.xml"))
    data, tree = mujoco.MjData(model), Tree(REPOSITORY / told["hand_file"], told["root_link"])
    assert model.nkey == len(plan["time_s"])
    for k in range(model.nkey):
        mujoco.mj_resetDataKeyframe(model, data, k)
        mujoco.mj_forward(model, data)
        assert data.time == pytest.approx(plan["time_s"][k], abs=1e-9)
        for contact in told["contacts"]:
            expected = tree.pose(contact["link"], dict(zip(plan["joints"], true["q"][k], strict=True)))
            body = data.body(contact["link"])
            np.testing.assert_allclose(body.xmat.reshape(3, 3), expected[0], **CLOSE)
            np.testing.assert_allclose(body.xpos, expected[1], **CLOSE)
            centre = expected[0] @ contact["pad_centre_m"] + expected[1]
            np.testing.assert_allclose(data.site(contact["name"]).xpos, centre, **CLOSE)
        held, du = data.body("object"), np.array(true["du"][k])
        np.testing.assert_allclose(held.xpos, np.array(told["object"]["position_m"]) + du[:3], **CLOSE)
        turned = Rotation.from_rotvec(du[3:]).as_matrix()
        np.testing.assert_allclose(held.xmat.reshape(3, 3), turned, **CLOSE)
    assert model.body("object").mass == pytest.approx(told["object"]["mass_kg"])
    np.testing.assert_allclose(2 * model.geom("object").size, told["object"]["shape"]["box"]["size_m"], **CLOSE)
    assert [model.joint(name).range.tolist() for name in plan["joints"]] == told["joint_range"]


def test_a_plan_in_code_is_exported_as_the_one_on_disk(moved: SimpleNamespace, tmp_path: Path) -> None:
    files = moved.answer.export(tmp_path / "new", to=["csv", "mjcf"])
    assert [path.name for path in files] == ["trajectory.csv", "keyframes.xml"]
    assert files[0].read_bytes() == (moved.folder / "trajectory.csv").read_bytes()
