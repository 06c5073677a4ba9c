"""Fingers that a rigid coupling stops while the hand closes: the refusal says what to write, and that is obeyed."""

import re
from pathlib import Path

import numpy as np
import pytest
from linkage_gripper import HAND_TOML, problem, urdf

from synergrip import InputError, load_problem, plan
from synergrip.files import bundled
from synergrip.hands.folder import load_hand

BODY = '<body name="{0}" pos="{1} {2} 0"><joint name="{0}" axis="{3}" range="-60 70"/></body>'
LINK = """<joint name="{0}" type="{4}"><parent link="palm"/><child link="{0}"/><origin xyz="{1} {2} 0"/>
<axis xyz="{3}"/><limit lower="-1" upper="1.2"/>{5}</joint>"""
PLACES = {"first": (0.0, 0.04, "1 0 0"), "second": (0.0, -0.04, "-1 0 0"), "third": (0.04, 0.0, "0 -1 0")}
BALL = """schema = 1
[hand]
model = "MODEL"
posture = { first = "-10 deg" }
close = "first"
compliance = { joint = "0.05 rad/(N m)" }
[object]
shape = { sphere = { radius = "20 mm" } }
position = ["X mm", "Y mm", "75 mm"]
[contacts]
model = "soft"
friction = 0.7
spin_friction = "5 mm"
stiffness = "8 N/mm"
spin_stiffness = "2 N m/rad"
"""
CONTACT = '[[contact]]\nlink = "{}"\npoint = ["0 mm", "0 mm", "75 mm"]\nradius = "8 mm"\n'


def model(kind: str, names: list[str], follows: str) -> str:
    """Return fingers in the plane z = 0 around the z axis that all follow one of them."""
    if kind == "xml":
        bodies = "".join(BODY.format(name, *PLACES[name]) for name in names)
        ties = "".join(f'<joint joint1="{name}" joint2="{follows}"/>\n' for name in names if name != follows)
        return (
            f'<mujoco><worldbody><body name="palm">{bodies}</body></worldbody>\n<equality>\n{ties}</equality></mujoco>'
        )
    mimic = f'<mimic joint="{follows}"/>'
    joints = "\n".join(LINK.format(name, *PLACES[name], "revolute", "" if name == follows else mimic) for name in names)
    links = "".join(f'<link name="{name}"/>' for name in ("palm", *names))
    return f'<robot name="h">{links}\n{joints}</robot>'


def messages(path: Path) -> list[str]:
    with pytest.raises(InputError) as caught:
        load_problem(path)
    return [issue.message for issue in caught.value.issues]


@pytest.mark.parametrize("kind", ["urdf", "xml"])
@pytest.mark.parametrize("names", [["first", "second"], ["first", "second", "third"]])
@pytest.mark.parametrize("follows", ["first", "second"])
@pytest.mark.parametrize("y", [6, -6])
def test_what_the_refusal_says_lets_the_hand_close(tmp_path, kind, names, follows, y):
    """Whichever finger touches first, and whichever of them leads."""
    (tmp_path / f"hand.{kind}").write_text(model(kind, names, follows), encoding="utf-8")
    text = BALL.replace("X", "5" if len(names) > 2 else "0").replace("Y", str(y)).replace("first", follows)
    text += "".join(CONTACT.format(name) for name in names)
    path = tmp_path / "ball.toml"
    path.write_text(text.replace("MODEL", f"hand.{kind}"), encoding="utf-8")
    found = messages(path)
    assert found
    lines: dict[str, None] = {}
    for message in found:
        assert "a rigid coupling stopped it" in message
        assert f"hand.{kind}:" in message
        assert "rigid = false" in message
        assert "hand.toml" in message
        lines |= dict.fromkeys(re.findall(r"\w+ = \{ joint = .*?rigid = false \}", message))
    joints = ", ".join(f'{{ name = "{name}" }}' for name in names)
    hand = f'schema = 1\ntitle = "h"\nmodel = "hand.{kind}"\njoint = [{joints}]\n[couplings]\n' + "\n".join(lines)
    hand += f"\n[synergies.motor]\ncolumns.close = {{ {follows} = 1 }}\n"
    (tmp_path / "hand.toml").write_text(hand, encoding="utf-8")
    path.write_text(text.replace("MODEL", "hand.toml"), encoding="utf-8")
    loaded = load_problem(path)
    assert loaded.notes == ()
    assert np.abs(loaded.held.gaps).max() < 1e-6
    assert plan(loaded.grasp, loaded.task).verdict == "feasible"


def test_the_example_of_the_readme(tmp_path):
    readme = (bundled("models") / "README.md").read_text(encoding="utf-8")
    (text,) = [block for block in re.findall(r"```toml\n(.*?)```", readme, re.DOTALL) if "differential" in block]
    (tmp_path / "hand.toml").write_text(text, encoding="utf-8")
    urdf = model("urdf", ["first", "second"], "first").replace("first", "left").replace("second", "right")
    (tmp_path / "gripper.urdf").write_text(urdf, encoding="utf-8")
    assert load_hand(tmp_path / "gripper.urdf").couplings["right"].rigid
    coupling = load_hand("hand.toml", relative_to=tmp_path).couplings["right"]
    assert (coupling.ratios, coupling.rigid) == ({"left": 1.0}, False)


def test_rigid_true_in_a_hand_toml_is_named_there(tmp_path):
    (tmp_path / "hand.urdf").write_text(model("urdf", ["first", "second"], "first"), encoding="utf-8")
    (tmp_path / "hand.toml").write_text(
        'schema = 1\ntitle = "h"\nmodel = "hand.urdf"\njoint = [{ name = "first" }, { name = "second" }]\n'
        '[couplings]\nsecond = { joint = "first", ratio = "1/2", offset = "3 deg", rigid = true }\n',
        encoding="utf-8",
    )
    text = BALL.replace("X", "0").replace("Y", "0") + CONTACT.format("first") + CONTACT.format("second")
    (tmp_path / "ball.toml").write_text(text.replace("MODEL", "hand.toml"), encoding="utf-8")
    (message,) = messages(tmp_path / "ball.toml")
    assert "hand.toml:6)" in message
    assert re.search(
        r'second = { joint = "first", ratio = 0.5, offset = "0.05235987755\d* rad", rigid = false }', message
    )


def test_a_finger_with_its_own_linkage_needs_only_what_ties_it_to_the_other_one(tmp_path):
    """The block is off the middle of a gripper of two parallel linkages: r_arm and r_tip follow the other finger."""
    (tmp_path / "hand.urdf").write_text(urdf(-0.9, 0.1), encoding="utf-8")
    (tmp_path / "off.toml").write_text(problem("hand.urdf", off=2), encoding="utf-8")
    (message,) = messages(tmp_path / "off.toml")
    assert re.findall(r"(\w+) = \{ joint", message) == ["r_arm", "r_tip"]
    lines = "\n".join(re.findall(r"\w+ = \{ joint = .*?rigid = false \}", message))
    (tmp_path / "hand.toml").write_text(f"{HAND_TOML}\n[couplings]\n{lines}\n", encoding="utf-8")
    (tmp_path / "off.toml").write_text(problem("hand.toml", off=2), encoding="utf-8")
    assert plan(*(lambda p: (p.grasp, p.timed))(load_problem(tmp_path / "off.toml"))).verdict == "feasible"


def test_a_finger_that_its_own_pad_stops_is_told_nothing_of_couplings(tmp_path):
    (tmp_path / "hand.urdf").write_text(model("urdf", ["first", "second"], "first"), encoding="utf-8")
    near = '[[contact]]\nname = "near"\nlink = "first"\npoint = ["0 mm", "0 mm", "60 mm"]\nradius = "1 mm"\n'
    text = BALL.replace("X", "0").replace("Y", "0") + CONTACT.format("first") + near
    (tmp_path / "ball.toml").write_text(text.replace("MODEL", "hand.urdf"), encoding="utf-8")
    (message,) = messages(tmp_path / "ball.toml")
    assert "'near' does not reach" in message
    assert "rigid" not in message
    assert "start from another posture" in message
