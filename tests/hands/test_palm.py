"""The palm as a link of the user's choice: what it does not carry stands still."""

from pathlib import Path

import numpy as np
import pytest
from mjcf_texts import NEEDED_BY_MUJOCO

from synergrip.errors import InputError
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Coupling

LINKS = "".join(f'<link name="{name}"/>' for name in ("base", "mast", "arm", "palm", "left", "right", "tip", "lamp"))


def joint(name, parent, child, kind="revolute", more=""):
    return f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
  <origin xyz="0.1 0.02 0.3" rpy="0.2 -0.4 0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="2"/>{more}</joint>\n"""


ARM = joint("lift", "base", "mast", "prismatic") + joint("turn", "mast", "arm") + joint("beam", "arm", "lamp")
HAND = (
    joint("flange", "arm", "palm", "fixed")
    + joint("left", "palm", "left")
    + joint("end", "left", "tip")
    + joint("right", "palm", "right", more='<mimic joint="left" multiplier="-1" offset="0.1"/>')
)
URDF = f'<robot name="both">{LINKS}\n{ARM}{HAND}</robot>'
MJCF = f"""<mujoco><compiler angle="radian"/><worldbody><body name="base">{NEEDED_BY_MUJOCO}
  <body name="mast" pos="0.1 0 0.3" euler="0.2 -0.4 0.5"><joint name="lift" type="slide"/>{NEEDED_BY_MUJOCO}
    <body name="lamp"><joint name="beam"/>{NEEDED_BY_MUJOCO}</body>
    <body name="palm" pos="0.1 0.02 0" euler="0.1 0.2 0.3"><joint name="turn" axis="0 1 0"/>{NEEDED_BY_MUJOCO}
      <body name="left" pos="0 0.1 0"><joint name="left" axis="1 0 0" range="-1 1"/>{NEEDED_BY_MUJOCO}
        <body name="tip" pos="0 0 0.1"><joint name="end" axis="1 0 0"/>{NEEDED_BY_MUJOCO}</body></body>
      <body name="right" pos="0 -0.1 0"><joint name="right" axis="1 0 0"/>{NEEDED_BY_MUJOCO}</body>
    </body></body></body></worldbody>
<equality><joint joint1="right" joint2="left" polycoef="0.1 -1"/></equality></mujoco>"""
FILES = {"urdf": ("hand.urdf", URDF), "mjcf": ("hand.xml", MJCF)}
every_format = pytest.mark.parametrize("kind", FILES)


def write(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def load(folder, kind, palm="", change=("", "")):
    name, text = FILES[kind]
    assert change[0] in text
    return load_hand(write(folder, name, text.replace(*change)), palm=palm)


@every_format
def test_what_the_palm_does_not_carry_stands_still(tmp_path, kind):
    hand = load(tmp_path, kind, "palm")
    assert hand.joint_names == ("left", "end", "right")
    assert (hand.links[0], set(hand.links)) == ("palm", {"palm", "left", "tip", "right"})
    assert set(hand.still) >= {"base", "mast", "lamp", "lift", "turn", "beam"}
    assert not set(hand.still) & {*hand.links, *hand.joint_names}
    assert hand.synergy_sets["free"].synergies == ("left", "end")
    assert hand.couplings == {"right": Coupling({"left": -1.0}, 0.1)}
    assert load(tmp_path, kind).still == ()


@every_format
def test_links_move_as_seen_from_the_palm_wherever_the_arm_is(tmp_path, kind):
    whole, part = load(tmp_path, kind), load(tmp_path, kind, "palm")
    rng = np.random.default_rng(3)
    point = np.array([0.01, -0.02, 0.03])
    for _ in range(5):
        values = dict(zip(whole.joint_names, rng.uniform(-1, 1, len(whole.joints)), strict=True))
        palm, tip = whole.kinematics.at(np.array(list(values.values())), [("palm", np.zeros(3)), ("tip", point)])
        (seen,) = part.kinematics.at(np.array([values[name] for name in part.joint_names]), [("tip", point)])
        turned = palm.rotation.T
        np.testing.assert_allclose(seen.position, turned @ (tip.position - palm.position), atol=1e-12)
        np.testing.assert_allclose(seen.rotation, turned @ tip.rotation, atol=1e-12)
        columns = [whole.joint_names.index(name) for name in part.joint_names]
        np.testing.assert_allclose(seen.jacobian[:3], turned @ tip.jacobian[:3, columns], atol=1e-12)


@every_format
def test_the_outermost_link_may_be_named_too(tmp_path, kind):
    hand = load(tmp_path, kind, "base")
    assert len(hand.joints) == 6
    assert hand.still == ()


@every_format
def test_a_link_that_is_not_there_is_refused_with_those_that_are(tmp_path, kind):
    with pytest.raises(InputError, match=r"'plam' is not one of .*did you mean 'palm'") as caught:
        load(tmp_path, kind, "plam")
    assert caught.value.issues[0].key == "palm"
    with pytest.raises(InputError) as caught:
        load_hand(tmp_path / FILES[kind][0], palm="plam", key="HAND")
    assert caught.value.issues[0].key == "palm"


@every_format
def test_a_palm_that_carries_nothing_that_moves_is_refused(tmp_path, kind):
    with pytest.raises(InputError, match="no joint that moves"):
        load(tmp_path, kind, "tip")


CROSSING = {
    "urdf": ('<mimic joint="left" multiplier="-1" offset="0.1"/>', '<mimic joint="turn"/>', "'right' mimics 'turn'"),
    "mjcf": ('joint2="left"', 'joint2="turn"', "ties joints that the palm 'palm' carries to joints that stand still"),
}


@every_format
def test_a_coupling_between_the_hand_and_what_stands_still_is_refused_where_it_stands(tmp_path, kind):
    old, new, message = CROSSING[kind]
    with pytest.raises(InputError, match=message) as caught:
        load(tmp_path, kind, "palm", (old, new))
    (issue,) = caught.value.issues
    assert issue.line == FILES[kind][1].replace(old, new).split(new)[0].count("\n") + 1
    assert Path(issue.file).name == FILES[kind][0]


def test_what_is_no_hand_above_the_palm_does_not_matter(tmp_path):
    floating = URDF.replace('name="lift" type="prismatic"', 'name="lift" type="floating"')
    path = write(tmp_path, "hand.urdf", floating)
    with pytest.raises(InputError, match="floating"):
        load_hand(path)
    assert load_hand(path, palm="palm").joint_names == ("left", "end", "right")
    ball = MJCF.replace('<joint name="beam"/>', '<joint name="beam" type="ball"/>')
    loop = ball.replace("<equality>", '<equality><connect body1="lamp" body2="base" anchor="0 0 0"/>')
    path = write(tmp_path, "hand.xml", loop)
    with pytest.raises(InputError, match="ball joint"):
        load_hand(path)
    assert load_hand(path, palm="palm").joint_names == ("left", "end", "right")


def test_one_of_two_floating_hands_can_be_chosen(tmp_path):
    hand = '<body name="{0}"><freejoint/><body name="{0} f"><joint name="{0} j"/></body></body>'
    text = f"<mujoco><worldbody>{hand.format('a')}{hand.format('b')}</worldbody></mujoco>"
    path = write(tmp_path, "two.xml", text)
    with pytest.raises(InputError, match="float and have joints"):
        load_hand(path)
    assert load_hand(path, palm="b").joint_names == ("b j",)


def test_a_tendon_that_crosses_the_wrist_moves_the_finger_alone_when_that_stands_still(tmp_path):
    tendon = """<tendon><fixed name="t"><joint joint="turn" coef="1"/><joint joint="end" coef="0.5"/></fixed></tendon>
      <actuator><motor tendon="t"/><motor joint="left"/></actuator>"""
    text = MJCF.replace("</mujoco>", f"{tendon}</mujoco>")
    path = write(tmp_path, "hand.xml", text)
    assert load_hand(path).couplings["end"].ratios == {"turn": 0.5}
    hand = load_hand(path, palm="palm")
    assert hand.synergy_sets["free"].synergies == ("left", "end")
    assert hand.drives.idle == ()


def test_a_spring_that_crosses_the_wrist_rests_where_the_still_wrist_has_it(tmp_path):
    tendon = """<tendon><fixed name="band" stiffness="8" springlength="0.3"><joint joint="turn" coef="1"/>
      <joint joint="end" coef="0.5"/></fixed></tendon><actuator><motor joint="left"/></actuator>"""
    text = MJCF.replace("</mujoco>", f"{tendon}</mujoco>").replace('name="turn"', 'name="turn" ref="0.2"')
    hand = load_hand(write(tmp_path, "hand.xml", text), palm="palm")
    assert hand.drives.sprung == pytest.approx({"end": 0.2})  # 0.2 + 0.5 end = 0.3
    np.testing.assert_allclose(hand.C_q, np.diag([0, 1 / (8 * 0.5**2), 0]), atol=1e-12)


TOML = """schema = 1
title = "A hand on an arm"
model = "hand.urdf"
palm = "palm"
joint = [{ name = "left" }, { name = "end" }, { name = "right" }]
"""


def test_a_hand_toml_names_its_palm(tmp_path):
    write(tmp_path, "hand.urdf", URDF)
    path = write(tmp_path, "hand.toml", TOML)
    hand = load_hand(tmp_path)
    assert (hand.links[0], hand.joint_names) == ("palm", ("left", "end", "right"))
    assert load_hand(tmp_path, palm="palm").links == hand.links
    with pytest.raises(InputError, match=r"'palm' is the palm of this hand, as its hand\.toml has it") as caught:
        load_hand(tmp_path, palm="arm")
    assert caught.value.issues[0].key == "palm"
    path.write_text(TOML.replace('palm = "palm"', 'palm = "plam"'), encoding="utf-8")
    with pytest.raises(InputError, match="did you mean 'palm'") as caught:
        load_hand(tmp_path)
    assert (caught.value.issues[0].key, caught.value.issues[0].line) == ("palm", 4)
