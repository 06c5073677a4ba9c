"""Robot files, archives, hands and synergy sets that were made to hang, to exhaust the memory or to crash."""

from __future__ import annotations

import io
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from hostile_files import CASES, SHOW, SHOW_FOLDER, SHOW_SET, SHOW_URDF, Lay, add, text, write

__all__ = ["CASES"]

CHECK = ("check", "@/plan.npz", "barrett-ball-hold")


def _mjcf(name: str, content: Callable[[], str | bytes], fragment: str, **others: str) -> None:
    add(f"mjcf-{name}", text("hand.xml", content, **others), SHOW, fragment, "hand.xml")


def _urdf(name: str, content: Callable[[], str | bytes], fragment: str) -> None:
    add(f"urdf-{name}", text("hand.urdf", content), SHOW_URDF, fragment, "hand.urdf")


def _world(inside: str, before: str = "") -> str:
    return f'<mujoco>{before}<worldbody><body name="palm">{inside}</body></worldbody></mujoco>'


def _body(name: str) -> str:
    return f'<body name="{name}"><joint name="{name}"/></body>'


def _model(name: str) -> str:
    return f'<asset><model name="m" file="{name}"/></asset>'


def _attached(name: str, child: Callable[[], str | bytes], fragment: str) -> None:
    parent = _world('<attach model="m" body="palm" prefix="a"/>', _model("child.xml"))
    add(f"attached-{name}", text("child.xml", child, hand_xml=parent), SHOW, fragment, "child.xml")


# Any XML
_mjcf("unclosed-comments", lambda: "<mujoco>" + "<!-- " * 1_000_000, "this comment has no end")
_mjcf("comment-openings", lambda: "<mujoco>" + "<!--" * 3_900_000, "this comment has no end")
_mjcf("nearly-closed-comments", lambda: "<mujoco>" + "<!-- -- " * 1_500_000, "this comment has no end")
_mjcf("comments", lambda: "<mujoco>" + "<!---->" * 400_000 + "<joints/></mujoco>", "unrecognized element")
_mjcf("nested", lambda: "<mujoco>" + "<body>" * 1_000_000, "nested more than 200 deep")
_mjcf("elements", lambda: "<mujoco>" + "<geom/>" * 1_000_000 + "</mujoco>", "more than 50,000 elements")
_mjcf(
    "attributes",
    lambda: "<mujoco " + " ".join(f'a{i}=""' for i in range(600_000)) + "/>",
    "more than 500,000 attributes",
)
_mjcf(
    "some-attributes",
    lambda: "<mujoco " + " ".join(f'a{i}=""' for i in range(100_000)) + "/>",
    "has 100,000 attributes",
)
_mjcf("attribute", lambda: _world(f'<joint range="{"1 " * 7_000_000}"/>'), "<joint range> has 14,000,000 characters")
_mjcf("name", lambda: _world(f'<joint name="{"x" * 10_000_000}"/>'), "<joint name> has 10,000,000 characters")
_mjcf("tag", lambda: f"<{'x' * 10_000_000}/>", "a hand is a <robot>")
_mjcf("text", lambda: "<mujoco>" + "x" * 15_000_000, "not XML")
_mjcf("instructions", lambda: "<mujoco>" + "<?x?>" * 2_000_000, "not XML")
_mjcf("unclosed-cdata", lambda: "<mujoco><![CDATA[" + "]" * 15_000_000, "not XML")
_mjcf(
    "entity-bomb",
    lambda: (
        '<!DOCTYPE m [<!ENTITY a "'
        + "x" * 10_000
        + '">'
        + "".join(f'<!ENTITY a{i} "&a{i - 1};&a{i - 1};">' for i in range(1, 40))
        + "]><mujoco>&a39;</mujoco>"
    ),
    "DOCTYPE",
)
_mjcf("outer-entity", lambda: '<!DOCTYPE m [<!ENTITY a SYSTEM "/dev/zero">]><mujoco>&a;</mujoco>', "DOCTYPE")
_mjcf("outer-type", lambda: '<!DOCTYPE m SYSTEM "/dev/zero"><mujoco/>', "DOCTYPE")
_mjcf("references", lambda: "<mujoco>" + "&#x41;" * 2_000_000, "not XML")
_mjcf("nul", lambda: "<mujoco>\0</mujoco>", "not XML")
_mjcf("utf-16", lambda: "<mujoco/>".encode("utf-16"), "not UTF-8")
_mjcf("other-encoding", lambda: '<?xml version="1.0" encoding="UTF-32"?><mujoco/>', "no joint that moves")
_mjcf("nothing", lambda: "", "not XML")
_mjcf("three-marks", lambda: "\ufeff\ufeff\ufeff<mujoco/>", "not XML")

# MJCF
_mjcf(
    "replicate", lambda: _world(f'<replicate count="1000000">{_body("a")}</replicate>'), "<replicate> makes more than"
)
_mjcf("empty-replicate", lambda: _world('<replicate count="1000000"/>'), "<replicate> makes more than")
_mjcf(
    "replicate-of-replicates",
    lambda: _world('<replicate count="30">' * 5 + _body("a") + "</replicate>" * 5),
    "<replicate> makes more than",
)
_mjcf("replicates", lambda: _world(f'<replicate count="3">{_body("a")}</replicate>' * 300), "copies")
_mjcf(
    "replicate-of-many",
    lambda: _world('<replicate count="90">' + "".join(_body(f"a{i}") for i in range(40)) + "</replicate>"),
    "elements",
)
_mjcf("huge-count", lambda: _world(f'<replicate count="{"9" * 300}"/>'), "<replicate> makes more than")
_mjcf("composite", lambda: _world('<composite type="cable" count="1000 1000 1000"/>'), "makes more than")
_mjcf(
    "flexcomp",
    lambda: _world(_body("a") + '<flexcomp count="1000 1000 1000" name="f"/><joint type="ball"/>'),
    "ball joint",
)
_mjcf("bodies", lambda: _world("".join(_body(f"a{i}") for i in range(20_000))), "more than 5,000 elements")
_mjcf("joints", lambda: _world("".join(_body(f"a{i}") for i in range(2400))), "a hand has at most 200")
_mjcf("joints-of-a-body", lambda: _world("<joint/>" * 4900), "MuJoCo says")
_mjcf(
    "equalities",
    lambda: (
        _world(_body("a") + _body("b"))[:-9]
        + "<equality>"
        + '<joint joint1="a" joint2="b"/>' * 4000
        + "</equality></mujoco>"
    ),
    "4000 equalities",
)
_mjcf(
    "actuators",
    lambda: _world(_body("a"))[:-9] + "<actuator>" + '<motor joint="a"/>' * 4000 + "</actuator></mujoco>",
    "4000 actuators",
)
_mjcf(
    "wraps",
    lambda: (
        _world(_body("a"))[:-9]
        + '<tendon><fixed name="t">'
        + '<joint joint="a" coef="1"/>' * 20_000
        + "</fixed></tendon></mujoco>"
    ),
    "more than 5,000 elements",
)
_mjcf(
    "classes",
    lambda: '<mujoco><default class="main">' + '<default class="a">' * 190 + "</default>" * 191 + "</mujoco>",
    "",
)
_mjcf("huge-numbers", lambda: _world('<joint pos="1e308 1e308 1e308"/>'), "expected finite numbers")

# What includes and attaches
_mjcf(
    "attaches-itself",
    lambda: _world('<attach model="m" body="palm" prefix="x"/>', _model("hand.xml")),
    "attaches itself",
)
_mjcf(
    "attaches-itself-by-a-link",
    lambda: _world('<attach model="m" body="palm" prefix="x"/>', _model("./../" + "/" * 9 + "hand.xml")),
    "is not there",
)
_mjcf("includes-itself", lambda: '<mujoco><include file="hand.xml"/></mujoco>', "is included twice")
_mjcf("includes-everything", lambda: '<mujoco><include file="/dev/zero"/></mujoco>', "")
_mjcf(
    "many-models",
    lambda: (
        "<mujoco><asset>" + "".join(f'<model name="m{i}" file="m.xml"/>' for i in range(2000)) + "</asset></mujoco>"
    ),
    "2000 models to attach",
    m_xml=_world(""),
)
_mjcf(
    "many-attached",
    lambda: _world("".join(f'<attach model="m" body="palm" prefix="{i}"/>' for i in range(2000)), _model("m.xml")),
    "makes more than",
    m_xml=_world(""),
)
_attached("nested", lambda: "<mujoco>" + "<body>" * 1_000_000, "nested more than 200 deep")
_attached("elements", lambda: "<mujoco>" + "<geom/>" * 1_000_000 + "</mujoco>", "more than 50,000 elements")
_attached(
    "replicate", lambda: _world(f'<replicate count="1000000">{_body("a")}</replicate>'), "<replicate> makes more than"
)
_attached("numbers", lambda: _world('<joint pos="nan 0 0"/>'), "expected finite numbers")
_attached("entity", lambda: '<!DOCTYPE m [<!ENTITY a SYSTEM "/dev/zero">]><mujoco>&a;</mujoco>', "DOCTYPE")
_attached("urdf", lambda: '<robot name="x"/>', "an attached model is a <mujoco>")
_attached("not-xml", lambda: b"\x00" * 1_000_000, "not XML")
_attached("schema", lambda: _world("<joints/>"), "unrecognized element")
_attached(
    "itself", lambda: _world('<attach model="m" body="palm" prefix="x"/>', _model("child.xml")), "attaches itself"
)
_attached(
    "its-parent",
    lambda: _world('<attach model="m" body="palm" prefix="x"/>', _model("hand.xml")),
    "attaches itself through others",
)
_attached("includes-its-parent", lambda: f"<mujoco>{_model('part.xml')}<include file='part.xml'/></mujoco>", "")


def _chain(depth: int, width: int) -> Lay:
    """Return models of which each attaches the next one `width` times."""

    def lay(folder: Path) -> None:
        for level in range(depth):
            models = "".join(f'<model name="m{i}" file="{level + 1}.xml"/>' for i in range(width))
            attached = "".join(f'<attach model="m{i}" body="palm" prefix="p{i}"/>' for i in range(width))
            name = f"{level}.xml" if level else "hand.xml"
            write(folder, name, _world(attached, f"<asset>{models}</asset>"))
        write(folder, f"{depth}.xml", _world(_body("a")))

    return lay


add("chain-of-attached-models", _chain(300, 1), SHOW, "more than 10 deep", "xml")
add("tree-of-attached-models", _chain(9, 10), SHOW, "makes more than", "xml")


def _includes(count: int, content: str, nested: bool = False) -> Lay:
    def lay(folder: Path) -> None:
        for i in range(count):
            further = f'<include file="{i + 1}.xml"/>' if nested and i < count - 1 else ""
            write(folder, f"{i}.xml", f"<mujoco>{content}{further}</mujoco>")
        first = 1 if nested else count
        named = "".join(f'<include file="{i}.xml"/>' for i in range(first))
        write(folder, "hand.xml", f"<mujoco>{named}</mujoco>")

    return lay


add("many-included-elements", _includes(20, "<geom/>" * 20_000), SHOW, "have more than 50,000 elements", "xml")
add("many-included-bytes", _includes(5, " " * 7_000_000), SHOW, "MB, the most that is read here", "xml")
add("chain-of-includes", _includes(1000, "", nested=True), SHOW, "nested more than 200 deep", "xml")

# URDF
_JOINT = (
    '<joint name="j{0}" type="revolute"><parent link="l{1}"/><child link="l{2}"/><limit lower="0" upper="1"/></joint>'
)


def _robot(links: int, joints: str) -> str:
    return "<robot>" + "".join(f'<link name="l{i}"/>' for i in range(links)) + joints + "</robot>"


def _fixed(count: int) -> str:
    return "".join(_JOINT.format(i, i, i + 1).replace("revolute", "fixed") for i in range(count))


_urdf("circle", lambda: _robot(3, "".join(_JOINT.format(i, i, (i + 1) % 3) for i in range(3))), "form a loop")
_urdf(
    "circle-beside-a-palm",
    lambda: _robot(4, _JOINT.format(9, 1, 2) + _JOINT.format(8, 2, 1) + _JOINT.format(7, 0, 3)),
    "form a loop",
)
_urdf(
    "long-circle",
    lambda: _robot(
        2000,
        "".join(
            _JOINT.format(i, i, (i + 1) % 2000).replace("revolute", "fixed") if i else _JOINT.format(0, 0, 1)
            for i in range(2000)
        ),
    ),
    "form a loop",
)
_urdf("own-child", lambda: _robot(1, _JOINT.format(0, 0, 0)), "form a loop")
_urdf("links", lambda: _robot(100_000, ""), "more than 50,000 elements")
_urdf("some-links", lambda: _robot(4900, _JOINT.format(0, 0, 1)), "are no child of a joint")
_urdf("chain", lambda: _robot(2400, _fixed(2399)), "no joint that moves")
_urdf("joints", lambda: _robot(1000, "".join(_JOINT.format(i, i, i + 1) for i in range(999))), "a hand has at most 200")
_urdf("same-names", lambda: "<robot>" + '<link name="a"/>' * 4900 + "</robot>", "two links are named")
_urdf("unknown-links", lambda: _robot(3000, _JOINT.format(0, "x" * 1_000_000, 1)), "is not one of")
_urdf(
    "numbers",
    lambda: _robot(2, _JOINT.format(0, 0, 1).replace("<parent", f'<origin xyz="{"1 " * 5_000_000}"/><parent')),
    "characters",
)
_urdf(
    "mimics",
    lambda: _robot(
        200,
        "".join(
            _JOINT.format(i, i, i + 1).replace("</joint>", f'<mimic joint="j{(i + 1) % 199}"/></joint>')
            for i in range(199)
        ),
    ),
    "",
)
_urdf("unclosed", lambda: "<robot>" + "<link>" * 1_000_000, "nested more than 200 deep")
_urdf("macros", lambda: "<robot>" + "<xacro:a/>" * 1_000_000, "more than 50,000 elements")


# Archives
def _header(shape: str, descr: str = "'<f8'") -> bytes:
    head = f"{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}".encode()
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head


def _archive(members: dict[str, bytes], packed: int = zipfile.ZIP_DEFLATED) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", packed) as archive:
        for name, raw in members.items():
            archive.writestr(f"{name}.npy", raw)
    return stream.getvalue()


def _npz(name: str, content: Callable[[], bytes], fragment: str) -> None:
    add(f"npz-{name}", text("plan.npz", content), CHECK, fragment, "plan.npz")


_TIMES = _header("(2,)") + np.array([0.0, 1.0]).tobytes()
_npz("claims-terabytes", lambda: _archive({"dz_r": _header("(10000000000, 100)"), "time_s": _TIMES}), "states")
_npz("claims-gigabytes", lambda: _archive({"time_s": _header("(1000000000,)") + bytes(800), "dz_r": _TIMES}), "states")
_npz("claims-more-than-there-is", lambda: _archive({"time_s": _header(f"({2**70},)"), "dz_r": _TIMES}), "states")
_npz("negative", lambda: _archive({"time_s": _header("(-1,)"), "dz_r": _TIMES}), "states")
_npz("bomb", lambda: _archive({"dz_r": _header("(500000000, 1)") + bytes(200_000_000)}), "larger than 128 MB")
_npz("many-large", lambda: _archive({"dz_r": _TIMES, "time_s": bytes(100_000_000), "lambda": bytes(100_000_000)}), "")
_npz("members", lambda: _archive({f"m{i}": b"" for i in range(60_000)}), "more than 1000 members")
_npz("lzma", lambda: _archive({"dz_r": _TIMES, "time_s": _TIMES}, zipfile.ZIP_LZMA), "packed in another way")
_npz(
    "objects",
    lambda: _archive({"dz_r": _header("(1,)", "'|O'") + b"cos\nsystem\n", "time_s": _TIMES}),
    "no plain array",
)
_npz(
    "records",
    lambda: _archive({"dz_r": _header("(1,)", "[('a', '<f8')]") + bytes(8), "time_s": _TIMES}),
    "no plain array",
)
_npz("brackets", lambda: _archive({"dz_r": _header("(" * 5000), "time_s": _TIMES}), "no .npz archive")
_npz("long-header", lambda: _archive({"dz_r": _header("(" + "1," * 30_000 + ")"), "time_s": _TIMES}), "no .npz archive")
_npz("axes", lambda: _archive({"dz_r": _header("(" + "1," * 100 + ")") + bytes(8), "time_s": _TIMES}), "plan.npz")
_npz("no-archive", lambda: b"PK\x05\x06" + bytes(18) + b"x" * 1_000_000, "no .npz archive")
_npz("list-of-members", lambda: b"PK\x01\x02" * 7_000_000, "more than 1000 members")
_npz("cut", lambda: _archive({"dz_r": _TIMES, "time_s": _TIMES})[:-30], "no .npz archive")
_npz("texts", lambda: _archive({"dz_r": _header("(1, 1)", "'<U10'") + bytes(40), "time_s": _TIMES}), "plan.npz")


def _plan_json(name: str, content: Callable[[], str], fragment: str) -> None:
    add(
        f"plan-{name}", text("plan.json", content), ("check", "@/plan.json", "barrett-ball-hold"), fragment, "plan.json"
    )


_plan_json("nested", lambda: '{"dz_r": ' + "[" * 60 + "]" * 60 + ', "time_s": [0]}', "plan.json")
_plan_json("numbers", lambda: '{"dz_r": [' + "0," * 1_900_000 + '0], "time_s": [0]}', "plan.json")
_plan_json("ragged", lambda: '{"dz_r": [' + "[0]," * 200_000 + '[0,1]], "time_s": [0]}', "no array of numbers")
_plan_json("texts", lambda: '{"dz_r": [' + '"x",' * 1_900_000 + '0], "time_s": [0]}', "plan.json")
_plan_json("keys", lambda: "{" + ",".join(f'"k{i}":0' for i in range(60_000)) + "}", "50,000 keys")
_plan_json("verdict", lambda: '{"verdict": "' + "x" * 20_000_000 + '"}', "holds no plan")


def _exported(name: str, content: Callable[[], str], fragment: str) -> None:
    add(f"export-{name}", text("plan.json", content), ("export", "@/plan.json", "--to", "csv"), fragment, "plan.json")


_exported("nested", lambda: '{"dz_r": ' + "[" * 60 + "]" * 60 + ', "time_s": [0]}', "plan.json")
_exported(
    "numbers", lambda: '{"time_s": [' + "0," * 1_900_000 + '0], "dz_r": 0, "units": 0, "components": 0}', "plan.json"
)
_exported("names", lambda: '{"contacts": ["' + "x" * 20_000_000 + '"], "dz_r": 0, "time_s": [0]}', "plan.json")
_exported("verdict", lambda: '{"verdict": "' + "x" * 20_000_000 + '"}', "holds no plan")

# Hands and synergy sets
_SET = 'schema = 1\njoints = ["a"]\nsynergies = ["s"]\nS = [[1]]\n'


def _set(name: str, content: Callable[[], str], fragment: str) -> None:
    add(f"set-{name}", text("set.toml", content), SHOW_SET, fragment, "set.toml")


def _names(count: int, name: str = "j") -> str:
    return "[" + ",".join(f'"{name}{i}"' for i in range(count)) + "]"


_set("unknown-keys", lambda: _SET + "".join(f"k{i} = 1\n" for i in range(20_000)), "unknown key")
_set("joints", lambda: _SET.replace('["a"]', _names(20_000)), "at most 1000 entries")
_set(
    "unknown-joints", lambda: f"schema = 1\njoints = {_names(9000)}\nsynergies = ['s']\nS = [" + "[1]," * 9000 + "]", ""
)
_set("same-joints", lambda: _SET.replace('["a"]', "[" + '"a",' * 40_000 + "]"), "at most 1000 entries")
_set("900-same-joints", lambda: _SET.replace('["a"]', "[" + '"a",' * 900 + "]"), "listed twice")
_set("ragged", lambda: _SET.replace("[[1]]", "[" + "[]," * 20_000 + "]"), "")
_set(
    "matrix-500-by-500", lambda: _SET.replace("[[1]]", "[" + ("[" + "1," * 500 + "],") * 500 + "]"), "more than 50,000"
)
_set("texts", lambda: _SET.replace("[[1]]", "[[" + '"x",' * 40_000 + "]]"), "expected a number")
_set("twice", lambda: _SET + _SET, "written twice")

_HAND = 'schema = 1\ntitle = "x"\nmodel = "hand.urdf"\n[[joint]]\nname = "j0"\n'


def _hand(name: str, content: Callable[[], str], fragment: str) -> None:
    lay = text("hand/hand.toml", content, hand__hand_urdf=_robot(2, _JOINT.format(0, 0, 1)))
    add(f"hand-{name}", lay, SHOW_FOLDER, fragment, "hand.toml")


_hand("joints", lambda: _HAND + "".join(f"[[joint]]\nname = 'k{i}'\n" for i in range(9000)), "")
_hand("same-joints", lambda: _HAND + "[[joint]]\nname = 'j0'\n" * 12_000, "")
_hand(
    "pads",
    lambda: (
        _HAND + "".join(f"[pads.p{i}]\nlink = 'x'\npoint = ['0 m', '0 m', '0 m']\nnormal = 'x'\n" for i in range(4000))
    ),
    "",
)
_hand("postures", lambda: _HAND + "".join(f"[postures.p{i}]\njoints = {{ x{i} = '0 deg' }}\n" for i in range(6000)), "")
_hand("unknown-keys", lambda: _HAND + "".join(f"k{i} = 1\n" for i in range(20_000)), "unknown key")
_hand("couplings", lambda: _HAND + "".join(f"[couplings.c{i}]\njoint = 'j0'\nratio = 1\n" for i in range(9000)), "")
_hand("model", lambda: _HAND.replace("hand.urdf", "x" * 900_000), "")
_hand("nested", lambda: _HAND + "[postures.p]\nsynergies = " + "{a = " * 90 + "1" + "}" * 90, "nested too deeply")

# Texts of the command line
_BALL = ("plan", "barrett-ball-hold", "--set")
for _name, _value, _fragment in [
    ("nested", "task.x=" + "[" * 300 + "]" * 300, "nested too deeply"),
    ("deep-key", ".".join("a" * 30_000) + "=1", "a key has at most 64 parts"),
    ("deep-key-inside", "task.x={" + "a." * 30_000 + "a=1}", "error"),
    ("digits", "task.knots=" + "1" * 100_000, "error"),
    ("hexadecimal", "task.knots=0x" + "f" * 100_000, "the number is too large"),
    ("quantity", "limits.margin=1" + " " * 100_000 + "x", "is not a force"),
    ("index", "contact[999999999].at=1", "error"),
    ("quotes", '"' * 100_001, "error"),
]:
    add(f"override-{_name}", text("x", lambda: ""), (*_BALL, _value), _fragment)
