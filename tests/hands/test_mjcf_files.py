"""What an MJCF model consists of: everything passes our reader, and MuJoCo opens no file."""

import os
import re
from pathlib import Path

import pytest
from mjcf_texts import fingers

from synergrip.errors import InputError
from synergrip.hands.models.mjcf_source import kinematic_source
from synergrip.hands.models.model_file import read_model
from synergrip.hands.models.xml_elements import read_xml

FILES = """<compiler meshdir="{0}" texturedir="{0}" assetdir="{0}"/>
<extension><plugin plugin="x"><instance name="i"><config key="file" value="{0}/x"/></instance></plugin></extension>
<asset><mesh name="mesh" file="{0}/x.stl"/><texture name="t" type="2d" file="{0}/x.png"/><hfield name="h" file="{0}/x"/>
<skin name="s" file="{0}/x.skn"/><material name="m" texture="t"/></asset>
<worldbody><geom type="mesh" mesh="mesh"/><flexcomp name="f" type="mesh" file="{0}/x.obj"/></worldbody>"""


def with_files(text, folder):
    """Return a model with files of all sorts in `folder`."""
    return text.replace("</mujoco>", FILES.format(folder) + "</mujoco>")


def lay_out(folder, **texts):
    for name, content in texts.items():
        (folder / f"{name}.xml").write_text(content, encoding="utf-8")
    return folder / "hand.xml"


def attaching(file, times=1, name="m"):
    attached = "".join(f'<attach model="{name}" body="palm" prefix="p{i} "/>' for i in range(times))
    return f"""<mujoco><asset><model name="{name}" file="{file}"/></asset>
    <worldbody><body name="base">{attached}</body></worldbody></mujoco>"""


def refused(path):
    with pytest.raises(InputError) as caught:
        read_model(path)
    (issue,) = caught.value.issues
    return issue


@pytest.mark.parametrize("folder", ["/dev", "..", "../../../../../../../../dev", "link", "/nowhere"])
def test_mujoco_is_given_nothing_to_open(tmp_path, folder):
    (tmp_path / "link").symlink_to("/dev")
    finger = with_files(fingers(("a", "")), folder)
    path = lay_out(tmp_path, finger=finger, hand=with_files(attaching("finger.xml", 2), folder))
    source = kinematic_source(read_xml(path, "MJCF file"))
    texts = [source.text, *(raw.decode() for raw in source.files.values())]
    named = {name for text in texts for name in re.findall(r'file="([^"]*)"', text)}
    assert named == {"0.xml"} == set(source.files)
    assert not any(re.search(r"<(mesh|texture|hfield|skin|flexcomp|plugin|include)\b|dir=", text) for text in texts)
    assert read_model(path).moving == ("p0 a", "p1 a")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes in folders here")
def test_a_pipe_among_the_meshes_of_an_attached_model_holds_nobody_up(tmp_path):
    os.mkfifo(tmp_path / "x.stl")
    path = lay_out(tmp_path, finger=with_files(fingers(("a", "")), tmp_path), hand=attaching("finger.xml"))
    assert read_model(path).moving == ("p0 a",)


def test_attached_models_keep_their_own_units_and_attach_others(tmp_path):
    tip = '<mujoco><compiler angle="degree"/><worldbody><body name="palm"><joint name="t" range="0 90"/></body>'
    tip += "</worldbody></mujoco>"
    path = lay_out(
        tmp_path, tip=tip, finger=attaching("tip.xml", 2), hand=attaching("finger.xml").replace("palm", "base")
    )
    tree = read_model(path)
    assert tree.moving == ("p0 p0 t", "p0 p1 t")
    assert [tree.joints[name].upper for name in tree.moving] == pytest.approx([1.5708, 1.5708], abs=1e-4)


def test_what_is_wrong_in_an_attached_model_is_told_where_it_stands(tmp_path):
    bad = fingers(("a", "")).replace("<body", "\n<body").replace("<joint", '\n<joint sort="x"')
    path = lay_out(tmp_path, finger=bad, middle=attaching("finger.xml"), hand=attaching("middle.xml"))
    issue = refused(path)
    assert issue.message == "<joint>: MuJoCo says: unrecognized attribute: 'sort'"
    assert (Path(issue.file), issue.line) == (tmp_path / "finger.xml", 4)


@pytest.mark.parametrize(
    ("texts", "where"),
    [
        ({"hand": attaching("hand.xml")}, "hand"),
        ({"hand": attaching("a.xml"), "a": attaching("a.xml")}, "a"),
        ({"hand": attaching("a.xml"), "a": attaching("b.xml"), "b": attaching("hand.xml")}, "b"),
        ({"hand": attaching("sub/../hand.xml")}, "hand"),
        ({"hand": "<mujoco><include file='a.xml'/></mujoco>", "a": attaching("hand.xml")}, "a"),
        ({"hand": "<mujoco><include file='a.xml'/></mujoco>", "a": attaching("a.xml")}, "a"),
    ],
)
def test_a_model_that_attaches_itself_is_refused(tmp_path, texts, where):
    (tmp_path / "sub").mkdir()
    issue = refused(lay_out(tmp_path, **texts))
    assert "attaches itself" in issue.message
    assert (Path(issue.file), issue.line) == (tmp_path / f"{where}.xml", 1)


def test_a_model_that_attaches_itself_by_a_link_is_refused(tmp_path):
    (tmp_path / "other.xml").symlink_to("hand.xml")
    assert "attaches itself" in refused(lay_out(tmp_path, hand=attaching("other.xml"))).message


def test_one_file_may_be_attached_from_two_places(tmp_path):
    both = '<attach model="a" body="base" prefix="a "/><attach model="b" body="base" prefix="b "/>'
    hand = f"""<mujoco><asset><model name="a" file="a.xml"/><model name="b" file="b.xml"/></asset>
    <worldbody><body name="palm">{both}</body></worldbody></mujoco>"""
    finger = fingers(("j", ""))
    path = lay_out(tmp_path, finger=finger, a=attaching("finger.xml"), b=attaching("finger.xml"), hand=hand)
    assert read_model(path).moving == ("a p0 j", "b p0 j")


@pytest.mark.parametrize(("count", "allowed"), [(150, True), (501, False)])
def test_replicates_are_counted_before_mujoco_makes_them(tmp_path, count, allowed):
    text = fingers().replace("<body", f'<replicate count="{count}"><body').replace("</body>", "</body></replicate>")
    path = lay_out(tmp_path, hand=text.replace("</body></replicate>", "<joint/></body></replicate>"))
    if allowed:
        assert len(read_model(path).moving) == count
    else:
        assert "makes more than 500 copies" in refused(path).message
