"""Springs in joints that motors hold: what they take of the motors is said, as no limit counts it."""

import mujoco
import numpy as np
import pytest
from mjcf_texts import fingers, with_masses

from synergrip import load_hand
from synergrip.hands.undriven import undriven_notes

SPRUNG = 'axis="0 0 1" stiffness="2" springref="-0.7"'


def notes(folder, force, q, left=SPRUNG, more=""):
    """Return what is noted of two fingers with motors of a largest force, at some joint values, and the file."""
    motors = "".join(f'<position joint="{name}" forcerange="-{force} {force}"/>' for name in ("l", "r"))
    text = fingers(("l", left), ("r", 'axis="0 0 1"'), after=f"{more}<actuator>{motors}</actuator>")
    (folder / "hand.xml").write_text(text, encoding="utf-8")
    hand = load_hand(folder / "hand.xml")
    (chosen, *_) = hand.synergy_sets.values()
    return [note for note in undriven_notes(hand, chosen, np.array(q), hand.C_q) if "motors hold springs" in note], text


def test_springs_that_motors_hold_back_are_noted_with_what_they_take(tmp_path):
    q = [0.1, 0.2]
    (note,), text = notes(tmp_path, 0.5, q)
    model = with_masses(text)  # MuJoCo's own springs
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    takes = -data.qfrc_spring
    assert takes == pytest.approx([1.6, 0.0])
    assert "'l' with 1.6 N m, up to 320% of what they can" in note
    assert "'r' with" not in note


def test_springs_of_tendons_count_too(tmp_path):
    tendon = '<tendon><fixed stiffness="3" springlength="0.1"><joint joint="r" coef="2"/></fixed></tendon>'
    (note,), _ = notes(tmp_path, 10, [-0.7, 0.25], more=tendon)
    assert "'r' with 2.4 N m, up to 24% of what they can" in note


@pytest.mark.parametrize(("force", "q"), [(0.5, [-0.7, 0.3]), (500, [0.1, 0.2])])
def test_springs_at_rest_or_weak_beside_motors_are_not_noted(tmp_path, force, q):
    assert not notes(tmp_path, force, q)[0]
