"""A hand.toml beside an MJCF file with joints that no actuator drives: it has the last word, and silence is noted."""

import numpy as np
from mjcf_texts import fingers

from synergrip.hands.folder import load_hand

MJCF = fingers(("a", 'axis="1 0 0"'), ("b", 'axis="1 0 0" stiffness="0.5"'), ("c", 'axis="1 0 0"'),
               after='<actuator><motor joint="a"/></actuator>')  # fmt: skip
TOML = """schema = 1
title = "Three joints"
model = "hand.xml"
[[joint]]
name = "a"
[[joint]]
name = "b"
{compliance}
[[joint]]
name = "c"
{more}
"""
SILENT_ON_SYNERGIES = (
    "no actuator of hand.xml is known to drive {}, and hand.toml has no [synergies]: in the set 'joints' each of them "
    "moves by itself"
)
SILENT_ON_SPRINGS = "in hand.xml only springs hold 'b', and hand.toml gives no compliance: they are taken as rigid"


def notes(folder, compliance="", more=""):
    (folder / "hand.xml").write_text(MJCF, encoding="utf-8")
    (folder / "hand.toml").write_text(TOML.format(compliance=compliance, more=more), encoding="utf-8")
    hand = load_hand(folder)
    assert hand.drives.idle == ()
    return hand.drives.notes, hand


def test_silence_is_noted(tmp_path):
    found, hand = notes(tmp_path)
    assert found == (SILENT_ON_SYNERGIES.format("'b', 'c'"), SILENT_ON_SPRINGS)
    np.testing.assert_array_equal(hand.C_q, np.zeros((3, 3)))
    found, _ = notes(tmp_path, more='[couplings]\nc = { joint = "a", ratio = 1 }')
    assert found == (SILENT_ON_SYNERGIES.format("'b'"), SILENT_ON_SPRINGS)


def test_what_hand_toml_says_is_not_noted(tmp_path):
    synergies = "[synergies.motors]\ncolumns.close = { a = 1, b = 0.5 }"
    found, hand = notes(tmp_path, 'compliance = "1 rad/(N m)"', synergies)
    assert found == ()
    np.testing.assert_array_equal(hand.C_q, np.diag([0, 1.0, 0]))
    found, _ = notes(tmp_path, more=synergies)
    assert found == (SILENT_ON_SPRINGS,)
