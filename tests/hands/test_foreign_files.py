"""Names and files that people give as a hand: read as what they are, or told what they are and what to do."""

import re
from pathlib import Path

import pytest
from mjcf_texts import plain

from synergrip import InputError, load_problem
from synergrip.hands.folder import load_hand

URDF = """<robot name="r"><link name="p"/><link name="f"/>
<joint name="a" type="revolute"><parent link="p"/><child link="f"/><limit lower="-1" upper="1.5"/></joint>
</robot>"""
MJCF = plain("a")
XACRO = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n<xacro:property name="w" value="1"/>\n</robot>'


def refused(path: Path, **options):
    with pytest.raises(InputError) as caught:
        load_hand(path, **options)
    (issue,) = caught.value.issues
    return issue


@pytest.mark.parametrize("text", [URDF, MJCF], ids=["urdf", "mjcf"])
@pytest.mark.parametrize("name", ["h.urdf", "h.xml", "h.mjcf", "h.URDF", "h.Xml", "h.MJCF", "h.urdf.txt", "h.bak", "h"])
def test_what_a_file_holds_decides_whatever_its_name_is(tmp_path, text, name):
    (tmp_path / name).write_text(text, encoding="utf-8")
    assert load_hand(name, relative_to=tmp_path).joint_names == ("a",)


@pytest.mark.parametrize(
    ("name", "result"),
    [
        ("h.urdf.xacro", "h.urdf"), ("h.xacro", "h.urdf"), ("h.mjcf.xacro", "h.mjcf"), ("h.xml.xacro", "h.xml"),
        ("h.urdf.XACRO", "h.urdf"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("text", [XACRO, URDF])
def test_macros_are_to_be_expanded_first(tmp_path, name, result, text):
    (tmp_path / name).write_text(text, encoding="utf-8")
    issue = refused(tmp_path / name)
    assert issue.key == "name_or_path"
    assert f"expand it first, with `xacro {name} > {result}`" in issue.message
    (tmp_path / "hand.toml").write_text(
        f'schema = 1\ntitle = "h"\nmodel = "{name}"\njoint = [{{ name = "a" }}]\n', encoding="utf-8"
    )
    issue = refused(tmp_path)
    assert (issue.key, issue.line) == ("model", 3)
    assert f"expand it first, with `xacro {name} > {result}`" in issue.message


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("</robot>", "<xacro:finger/></robot>", 3),
        ('<link name="f"/>', '<link name="f">\n<xacro:inertia/></link>', 2),
        ('<link name="f"/>', '<link name="f"><inertial>\n<mass value="${m}"/></inertial></link>', 2),
        ('name="a"', 'name="${prefix}a"', 2),
        ('upper="1.5"', 'upper="$(arg reach)"', 2),
        ("</robot>", '<include filename="f.xacro"/></robot>', 3),
        ("</robot>", '<macro name="f"/></robot>', 3),
        ('name="r">', 'name="r" xmlns:x="http://www.ros.org/wiki/xacro"><x:if value="1"/>', 1),
    ],
)
@pytest.mark.parametrize("name", ["h.urdf", "h.xml"])
def test_macros_in_a_file_of_another_name_are_told_where_they_stand(tmp_path, old, new, line, name):
    assert URDF.count(old) == 1
    (tmp_path / name).write_text(URDF.replace(old, new), encoding="utf-8")
    issue = refused(tmp_path / name)
    assert (Path(issue.file), issue.line) == (tmp_path / name, line)
    assert "xacro" in issue.message
    assert "expand it first" in issue.message


def test_macros_in_an_mjcf_are_told_too(tmp_path):
    (tmp_path / "h.xml").write_text(MJCF.replace('axis="0 0 1"', 'axis="0 0 ${up}"'), encoding="utf-8")
    assert "<joint axis> is '0 0 ${up}', a xacro expression" in refused(tmp_path / "h.xml").message


def test_what_macros_leave_behind_is_no_macro(tmp_path):
    """The name space stays declared, and meshes may be found by a tool of ROS; neither bears on the joints."""
    text = URDF.replace("<robot ", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" ')
    mesh = '<link name="f"><visual><geometry><mesh filename="$(find pkg)/m.stl"/></geometry></visual></link>'
    (tmp_path / "h.urdf").write_text(text.replace('<link name="f"/>', mesh), encoding="utf-8")
    assert load_hand(tmp_path / "h.urdf").joint_names == ("a",)


@pytest.mark.parametrize(
    ("name", "fragment"),
    [
        ("h.sdf", "an SDF model"), ("h.SDF", "an SDF model"), ("w.world", "an SDF model"),
        ("h.usd", "a USD scene"), ("h.usda", "a USD scene"), ("h.usdc", "a USD scene"), ("h.usdz", "a USD scene"),
        ("h.mjb", "a model that MuJoCo has compiled"), ("h.srdf", "a list of groups and poses"),
        ("h.stl", "a mesh"), ("h.dae", "a mesh"), ("h.obj", "a mesh"), ("h.zip", "an archive"),
        ("h.tar.gz", "an archive"), ("h.yaml", "no robot description"), ("h.json", "no robot description"),
        ("my.toml", "not called hand.toml"),
    ],
)  # fmt: skip
def test_files_of_other_kinds_are_told_by_their_names(tmp_path, name, fragment):
    (tmp_path / name).write_bytes(b"\0\1\2 whatever")
    issue = refused(tmp_path / name)
    assert (issue.key, issue.file) == ("name_or_path", "")
    assert f"'{name}' is {fragment}" in issue.message
    assert re.search(r"; (give|unpack)", issue.message)
    problem = tmp_path / "p.toml"
    text = f'schema = 1\nhand = {{ model = "{name}", posture = "zero" }}\nobject = {{ mass = "1 g" }}\n'
    problem.write_text(text + '[contacts]\nat = ["x"]\nfriction = 1\nstiffness = "1 N/mm"\n', encoding="utf-8")
    with pytest.raises(InputError, match=fragment) as caught:
        load_problem(problem)
    assert (caught.value.issues[0].line, caught.value.issues[0].key) == (2, "hand.model")


@pytest.mark.parametrize(
    ("text", "fragment"),
    [
        ("<sdf version='1.9'/>", "an SDF model"), ("<COLLADA/>", "a mesh"), ("<launch/>", "a ROS launch file"),
        ("<mujocoinclude/>", "another MJCF includes"), ("<package/>", "a ROS package"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("name", ["h.urdf", "h.xml", "h.mjcf"])
def test_files_of_other_kinds_are_told_by_what_they_hold(tmp_path, text, fragment, name):
    (tmp_path / name).write_text(text, encoding="utf-8")
    issue = refused(tmp_path / name)
    assert fragment in issue.message
    assert (Path(issue.file), issue.line) == (tmp_path / name, 1)


@pytest.mark.parametrize("name", ["h.xacro", "h.urdf", "h.mjcf", "h.XML"])
def test_a_model_file_that_is_not_there_is_not_found(tmp_path, name):
    (tmp_path / "hand.urdf").write_text(URDF, encoding="utf-8")
    assert "not found" in refused(tmp_path / name).message


def test_a_folder_without_hand_toml_names_the_model_files_in_it(tmp_path):
    for place in ("hand.urdf", "urdf/left.urdf", "mjcf/scene.xml", "meshes/m.xml"):
        (tmp_path / "pkg" / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "pkg" / place).write_text(URDF, encoding="utf-8")
    message = refused(Path("pkg"), relative_to=tmp_path).message
    assert "did you mean the model file 'pkg/hand.urdf' or 'pkg/mjcf/scene.xml' or 'pkg/urdf/left.urdf'?" in message


def test_a_name_without_its_suffix_finds_its_file(tmp_path):
    (tmp_path / "leap.xml").write_text(MJCF, encoding="utf-8")
    message = refused(Path("leap"), relative_to=tmp_path).message
    assert "did you mean the model file 'leap.xml'?" in message
