"""Plans played in the physics engine: a gripper that holds a box, what is too slippery, and what is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import document, run

import synergrip
from synergrip.errors import InputError
from synergrip.grasps.shapes.shapes import SHAPES
from synergrip.simulation.geoms import GEOMS, sizes_of
from synergrip.simulation.joint_springs import joint_springs
from synergrip.simulation.played_plan import read_played_plan
from synergrip.simulation.timeline import timeline
from synergrip.simulation.told_values import Told


def test_forces_of_a_box_that_is_held_are_those_of_the_plan(held: Path, played: synergrip.Simulation) -> None:
    plan = json.loads((held / "plan.json").read_text())
    assert played.verdict == "held"
    assert played.exit_code == 0
    largest = np.abs(plan["lambda"]).max()
    assert np.abs(played.forces[-1] - plan["lambda"][-1]).max() < 0.01 * largest
    assert np.abs(played.forces[0] - plan["lambda"][0]).max() < 0.01 * largest
    assert played.worst[0] == pytest.approx(played.promised_worst, abs=0.02 * largest)
    assert played.motion_error[0] < 2e-5
    assert played.slip.max() < 5e-6


def test_half_the_step_gives_the_same(played: synergrip.Simulation) -> None:
    assert played.half_step is not None
    margin, shift = played.half_step
    assert 0 < margin < 0.005
    assert shift < 5e-6


def test_too_little_friction_slips_and_says_so(held: Path, tmp_path: Path) -> None:
    """With somewhat less friction than is needed the box cannot be held, whose weight the tips carry by it alone."""
    found = document("simulate", str(held), "--friction", "0.68", "--once", "-o", str(tmp_path / "out"), code=3)
    assert found["verdict"] in ("slipped", "lost contact")
    assert found["slipped"] == found["contacts"]
    assert found["margin"]["worst_N"] == 0, "what slides is on its cone, to rounding"
    assert np.min(found["margin"]["per_contact_N"]) == 0
    assert found["at_cone"] == found["contacts"]
    assert min(found["on_cone_s"]) > 0.02
    assert all(start < end for start, end in found["cone_at_s"])
    assert min(found["crept_m"]) > 5e-5
    differs = found["differs"]
    assert {each["contact"] for each in differs["contacts"]} == set(found["contacts"])
    assert "friction was multiplied by 0.68" in differs["likely_cause"]
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"model.xml", "simulation.json", "simulation.csv"}
    assert json.loads((tmp_path / "out" / "simulation.json").read_text()) == found


def test_the_text_and_the_picture(held: Path, tmp_path: Path) -> None:
    picture = tmp_path / "held.svg"
    result = run("simulate", str(held), "--once", "--speed", "real", "--picture", str(picture))
    assert result.exit_code == 0, result.output
    assert "every contact touched and none slipped" in result.stdout
    assert "N promised" in result.stdout
    assert picture.read_text().startswith("<?xml")
    assert "playing" in result.stderr


def changed(held: Path, folder: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    """Return a copy of a plan.json in which something is changed."""
    data = json.loads((held / "plan.json").read_text())
    change(data)
    path = folder / "plan.json"
    path.write_text(json.dumps(data))
    return path


def rigid(data: dict[str, Any]) -> None:
    data["execution"]["contacts"][1]["compliance"] = np.zeros((4, 4)).tolist()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda data: data["execution"]["object"].update(shape=None), ("object.shape", "bare mass")),
        (
            lambda data: data["execution"]["object"].update(shape={"bal": {"radius_m": 0.05}}),
            ("object.shape", "'bal' is not one of 'sphere'"),
        ),
        (
            lambda data: data["execution"]["object"].update(shape={"sphere": {"radius_m": -0.05}}),
            ("object.shape.sphere.radius_m", "greater than 0"),
        ),
        (lambda data: data["execution"].update(sha256="0"), ("execution.sha256", "plan again")),
        (rigid, ("contacts[1].compliance", "right/tip", "rigid")),
        (lambda data: data["execution"]["contacts"][0].update(kind="patch"), ("contacts[0]", "patch_radius_m")),
        (lambda data: data.pop("execution"), ("given as matrices",)),
        (lambda data: data["execution"].pop("S"), ("execution.S", "missing")),
        (lambda data: data["execution"].update(q_0=[0.0, 1.0]), ("execution.q_0", "4 finite numbers")),
        (lambda data: data.pop("dz_r"), ("holds no plan",)),
    ],
)
def test_refusals_name_what_is_missing(
    held: Path, tmp_path: Path, change: Callable[[dict[str, Any]], object], said: tuple[str, ...]
) -> None:
    with pytest.raises(InputError) as refused:
        synergrip.simulate(changed(held, tmp_path, change), half_step=False)
    for words in said:
        assert words in str(refused.value)


@pytest.mark.parametrize("name", GEOMS)
def test_a_shape_is_played_with_the_surface_and_the_size_that_it_has(name: str) -> None:
    """From plan.json to the model of MuJoCo: points of the surface are there where our shape says."""
    import mujoco

    lengths = iter((0.03, 0.05, 0.08))
    sizes = {size.name: next(lengths) if size.count == 1 else [next(lengths) for _ in range(size.count)]
             for size in SHAPES[name].sizes}  # fmt: skip
    told = {f"{key}_m": value for key, value in sizes.items()} | {"rotation": np.eye(3).tolist()}
    read = sizes_of(name, Told({"shape": told}, "").inside("shape"))
    spec, ray = mujoco.MjSpec(), np.array([-1], dtype=np.int32)
    spec.worldbody.add_geom(type=getattr(mujoco.mjtGeom, GEOMS[name].kind), size=GEOMS[name].size(read).tolist())
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    shape = SHAPES[name](**sizes)
    for direction in np.random.default_rng(5).normal(size=(50, 3)):
        along = direction / np.linalg.norm(direction)
        hit = mujoco.mj_ray(model, data, -0.3 * along, along, None, 1, -1, ray)
        assert shape.surface((hit - 0.3) * along)[0] == pytest.approx(0, abs=1e-9)


def test_a_shape_that_is_planned_with_and_not_played_is_refused_as_such(
    held: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(GEOMS, "box")
    with pytest.raises(InputError, match=r"MuJoCo does not play the shape 'box'; it plays sphere"):
        synergrip.simulate(held, half_step=False)


def test_bad_plan_files_and_arguments_end_with_2(held: Path, tmp_path: Path) -> None:
    assert run("simulate", str(tmp_path / "none")).exit_code == 2
    assert run("simulate", str(held), "--step", "-1").exit_code == 2
    with pytest.raises(InputError, match="speed"):
        synergrip.simulate(held, speed="fast")
    with pytest.raises(InputError, match="plan"):
        synergrip.simulate(3)  # type: ignore[arg-type]


def test_springs_of_joints_are_the_inverse_where_something_gives() -> None:
    rng = np.random.default_rng(3)
    S = rng.normal(size=(5, 2))
    C = S @ np.diag([0.2, 0.03]) @ S.T
    springs = joint_springs(C)
    torque = rng.normal(size=5)
    moved = -C @ torque
    assert springs.count == 3
    assert -springs.K @ moved == pytest.approx(springs.held @ torque, abs=1e-9)
    assert springs.prescribed @ moved == pytest.approx(np.zeros(5), abs=1e-12)


def test_joints_that_do_not_give_follow_their_references(held: Path, tmp_path: Path) -> None:
    """All joints stiff: the pads alone give, and carry what they did and what the joints' way squeezes them by."""

    def stiff(data: dict[str, Any]) -> None:
        data["execution"]["C_q"] = np.zeros((4, 4)).tolist()
        data["dz_r"] = (0.1 * np.array(data["dz_r"])).tolist()

    path = changed(held, tmp_path, stiff)
    plan = read_played_plan(path)
    found = synergrip.simulate(path, half_step=False, friction=5.0)
    wanted = plan.q_0 + plan.S @ plan.dz_r[-1]
    assert found.q[-1] == pytest.approx(wanted, abs=1e-9)
    points = [plan.kinematics.at(q, [(plan.pads[0].link, plan.pads[0].centre)])[0].position for q in (plan.q_0, wanted)]
    normal = plan.pads[0].contact.normal @ (points[1] - points[0]) / plan.pads[0].compliance[0, 0]
    assert normal > 0.1
    assert found.forces[-1, 0] == pytest.approx(plan.forces_0[0][0] + normal, rel=0.005)


def test_the_timeline_passes_all_knots_and_is_as_long_as_the_plan_at_its_own_speed(held: Path) -> None:
    plan = read_played_plan(held)
    line = timeline(plan, "real")
    assert line.duration == pytest.approx(plan.times[-1] - plan.times[0])
    for time, dz_r in zip(plan.times, plan.dz_r, strict=True):
        assert line.applied(time - plan.times[0]).dz_r == pytest.approx(dz_r, abs=1e-12)


def test_once_is_told_apart_from_how_a_plan_is_linearised() -> None:
    told = " ".join(run("simulate", "--help").stdout.replace("│", " ").split())
    assert "not again at half the step" in told
    assert 'task.linearise of the plan is: there "once" is how it was planned' in told
