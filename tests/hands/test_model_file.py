from pathlib import Path

import numpy as np
import pytest
from damaged import refusals
from mjcf_texts import plain

from synergrip.errors import InputError
from synergrip.hands.hand import Coupling
from synergrip.hands.models.model_file import read_model

URDF = """<robot name="r"><link name="p"/><link name="f"/><link name="g"/>
<joint name="a" type="revolute"><parent link="p"/><child link="f"/><origin xyz="0 0.1 0" rpy="1.5 0 0"/>
  <axis xyz="0 0 1"/><limit lower="-1" upper="1.5" effort="2"/></joint>
<joint name="b" type="continuous"><parent link="p"/><child link="g"/><mimic joint="a" multiplier="2"/></joint>
</robot>"""
MJCF = plain("a", "b", after='<equality><joint joint1="b" joint2="a" polycoef="0 2 0 0 0"/></equality>')


@pytest.mark.parametrize("suffix", [".urdf", ".xml", ".txt"])
@pytest.mark.parametrize("text", [URDF, MJCF], ids=["urdf", "mjcf"])
def test_the_outermost_element_decides_whatever_the_name_is(tmp_path, text, suffix):
    path = tmp_path / f"hand{suffix}"
    path.write_text(text, encoding="utf-8")
    tree = read_model(path)
    assert tree.moving == ("a", "b")
    assert tree.couplings == {"b": Coupling({"a": 2}, 0)}


@pytest.mark.parametrize(
    ("text", "fragment", "line"),
    [
        ("<sdf version='1.6'/>", "'sdf' is not one of 'robot' or 'mujoco'", 1),
        ("\n<mujocoo/>", "did you mean 'mujoco'?", 2),
        ("", "not XML: no element found", 1),
        ("<mujoco>\n<a/>", "not XML", 2),
        ("<robot name='\x01'/>", "not XML", 1),
        ("<robot>&secret;</robot>", "not XML: undefined entity", 1),
        ('<!DOCTYPE m [\n<!ENTITY e "x">]><mujoco/>', "DOCTYPE", 1),
        ("<mujoco>" + "<body>" * 300, "nested more than 200 deep", 1),
    ],
)
def test_what_is_no_model_is_refused_where_it_stands(tmp_path, text, fragment, line):
    path = tmp_path / "hand.xml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_model(path, "hand.model")
    (issue,) = caught.value.issues
    assert fragment in issue.message
    assert (Path(issue.file), issue.line) == (path, line)


def test_a_missing_file_is_told_at_the_key_that_names_it(tmp_path):
    (tmp_path / "hand.urdf").write_text(URDF, encoding="utf-8")
    with pytest.raises(InputError, match=r"not found; did you mean 'hand\.urdf'") as caught:
        read_model(tmp_path / "hnad.urdf", "hand.model")
    assert (caught.value.issues[0].key, caught.value.issues[0].file) == ("hand.model", "")


@pytest.mark.parametrize("text", [URDF, MJCF], ids=["urdf", "mjcf"])
def test_a_damaged_file_loads_or_is_refused(text, tmp_path, monkeypatch):
    def look(hand):
        assert np.all(np.isfinite(hand.postures["zero"]))

    monkeypatch.chdir(tmp_path)
    assert 50 < len(refusals(text, 5, 150, look)) < 149
