"""Broken inputs: the files of a problem, the key at fault and a piece of the message.

Each case stands for one folder with ``problem.toml`` in it, so that the same table serves the functions
that read files and the command line.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class BadInput:
    name: str
    files: dict[str, bytes]
    key: str
    fragment: str
    file: str = "problem.toml"
    """The file the first issue points at."""


SEVERAL = {"soft-without-spin": 2, "two-grasps": 3, "header": 2, "column-twice": 2}
"""Cases in which more than one issue is rightly found."""

_INTACT = Path(__file__).parent / "data" / "bad_inputs"

HAND = (_INTACT / "hand.toml").read_text(encoding="utf-8")
MATRICES = (_INTACT / "matrices.toml").read_text(encoding="utf-8")
WRENCH = (_INTACT / "wrench.csv").read_text(encoding="utf-8")
GRASP = (_INTACT / "grasp.json").read_text(encoding="utf-8")

CASES: list[BadInput] = []


def _add(name: str, files: dict[str, str | bytes], key: str, fragment: str, file: str = "problem.toml") -> None:
    raw = {path: text if isinstance(text, bytes) else text.encode() for path, text in files.items()}
    CASES.append(BadInput(name, raw, key, fragment, file))


def _hand(name: str, old: str, new: str, key: str, fragment: str) -> None:
    if HAND.count(old) != 1:
        raise ValueError(f"{name}: {old!r} must stand once in the problem")
    _add(name, {"problem.toml": HAND.replace(old, new)}, key, fragment)


def _matrices(name: str, change: Callable[[dict[str, Any]], object], key: str, fragment: str) -> None:
    data = json.loads(GRASP)
    change(data)
    files: dict[str, str | bytes] = {"problem.toml": MATRICES, "wrench.csv": WRENCH, "grasp.json": json.dumps(data)}
    _add(name, files, key, fragment, "grasp.json")


def _csv(name: str, text: str | bytes, fragment: str) -> None:
    files: dict[str, str | bytes] = {"problem.toml": MATRICES, "wrench.csv": text, "grasp.json": GRASP}
    _add(name, files, "task.wrench", fragment, "wrench.csv")


def _entry(matrix: str, i: int, j: int, value: object) -> Callable[[dict[str, Any]], object]:
    return lambda data: data[matrix][i].__setitem__(j, value)


def _contact(**changes: object) -> Callable[[dict[str, Any]], object]:
    return lambda data: data["contacts"][1].update(changes)


_add("no-file", {}, "", "not found")
_add("a-directory", {"problem.toml/inside.txt": ""}, "", "is a directory")
_add("not-utf-8", {"problem.toml": b"schema = 1\ntitle = '\xff'\n"}, "", "not UTF-8")
_add("empty-file", {"problem.toml": ""}, "schema", "missing key 'schema'")
_add("syntax", {"problem.toml": "schema = \n"}, "", "not valid TOML: invalid value")
_add("unclosed-list", {"problem.toml": "schema = 1\nx = [1,\n"}, "", "not valid TOML")
_add("too-deep", {"problem.toml": "x = " + "[" * 2000 + "]" * 2000}, "", "nested too deeply")
_add("nothing-but-schema", {"problem.toml": "schema = 1\n"}, "", "nothing to grasp with")
_hand("duplicate-key", "knots = 11", "knots = 11\nknots = 12", "task.knots", "written twice (first in line 19)")
_hand("duplicate-table", "[goal]", "[limits]", "limits", "written twice")
_hand("future-schema", "schema = 1", "schema = 7\nnew = 1", "schema", "written for schema 7")
_hand("schema-text", "schema = 1", 'schema = "1"', "schema", "expected 1, got '1'")
_hand("schema-true", "schema = 1", "schema = true", "schema", "expected 1, got true")
_hand("unknown-table", "[goal]", "[gaol]", "gaol", "unknown key 'gaol'; did you mean 'goal'?")
_hand("unknown-key", "friction = 0.6", "fricton = 0.6", "contacts.fricton", "did you mean 'friction'?")
_hand(
    "unknown-key-far",
    "mass =",
    "colour = 1\nmass =",
    "object.colour",
    "known keys: title, shape, mass, position, orientation",
)
_hand("no-hand", '[hand]\nmodel = "barrett"\nsynergies = 4\n', "", "hand", "missing table [hand]")
_hand("no-model", 'model = "barrett"\n', "", "hand.model", "missing key 'model'")
_hand("no-contacts", 'at = ["finger1/tip", "finger2/tip", "finger3/tip"]', "", "contacts.at", "no contacts")
_hand("no-friction", "friction = 0.6\n", "", "contacts.friction", "missing key 'friction'; a hard contact needs it")
_hand("no-stiffness", 'stiffness = "8 N/mm"\n', "", "contacts.stiffness", "missing key 'stiffness'")
_hand("soft-without-spin", '"hard"', '"soft"', "contacts.spin_friction", "a soft contact needs it")
_hand("negative-friction", "= 0.6", "= -0.6", "contacts.friction", "must be greater than 0, got -0.6")
_hand("zero-friction", "= 0.6", "= 0", "contacts.friction", "must be greater than 0")
_hand("nan-friction", "= 0.6", "= nan", "contacts.friction", "nan is not a finite number")
_hand("infinite-friction", "= 0.6", "= inf", "contacts.friction", "inf is not a finite number")
_hand("huge-friction", "= 0.6", "= 1" + "0" * 400, "contacts.friction", "too large")
_hand("text-friction", "= 0.6", '= "0.6"', "contacts.friction", "expected a number, got '0.6'")
_hand("true-friction", "= 0.6", "= true", "contacts.friction", "expected a number, got true")
_hand("contact-model", '"hard"', '"hrad"', "contacts.model", "did you mean 'hard'?")
_hand("pad-twice", "finger2/tip", "finger1/tip", "contacts.at[1]", "named twice")
_hand("pad-number", '"finger2/tip"', "2", "contacts.at[1]", "expected a string, got 2")
_hand("missing-unit", '"0.5 N"', '"0.5"', "limits.margin", 'missing unit; write "0.5 N"')
_hand("number-for-quantity", '"0.5 N"', "0.5", "limits.margin", '0.5 has no unit; expected a force such as "0.5 N"')
_hand("unknown-unit", '"0.5 N"', '"0.5 Newton"', "limits.margin", "unknown unit 'Newton'")
_hand("unit-of-another-kind", '"0.5 N"', '"0.5 mm"', "limits.margin", "'mm' is a unit of length")
_hand("negative-margin", '"0.5 N"', '"-0.5 N"', "limits.margin", "must be at least 0")
_hand("infinite-quantity", '"0.5 N"', '"1e999 N"', "limits.margin", "is not finite")
_hand("no-number", '"0.5 N"', '"half a N"', "limits.margin", "is not a force")
_hand("zero-radius", '"45 mm"', '"0 mm"', "object.shape.sphere.radius", "must be greater than 0")
_hand(
    "two-shapes",
    "{ sphere",
    '{ cylinder = { radius = "1 m", height = "1 m" }, sphere',
    "object.shape.cylinder",
    "one shape",
)
_hand("no-shape", '{ sphere = { radius = "45 mm" } }', "{}", "object.shape", "name one shape")
_hand(
    "box-of-two", 'sphere = { radius = "45 mm" }', 'box = { size = ["1 m", "1 m"] }', "object.shape.box.size", "got 2"
)
_hand("orientation-number", "mass =", "orientation = 90\nmass =", "object.orientation", "expected a table, got 90")
_hand(
    "orientation-angle",
    "mass =",
    "orientation = { axis = 'x', angle = 90 }\nmass =",
    "object.orientation.angle",
    "90 has no unit; expected an angle",
)
_hand(
    "orientation-axis",
    "mass =",
    "orientation = { axis = [1, 0], angle = '1 deg' }\nmass =",
    "object.orientation.axis",
    "expected 3 numbers, got 2",
)
_hand(
    "orientation-of-nothing",
    'shape = { sphere = { radius = "45 mm" } }',
    "orientation = { axis = 'x', angle = '1 deg' }",
    "object.orientation",
    "an orientation turns the shape; give object.shape",
)
_hand("zero-mass", '"200 g"', '"0 g"', "object.mass", "must be greater than 0")
_hand("gravity-without-mass", 'mass = "200 g"\n', "", "task.gravity", "gravity needs the mass of the object")
_hand("gravity-of-two", "[0, 0, -9.81]", "[0, -9.81]", "task.gravity", "expected 3 numbers, got 2")
_hand("gravity-text", "[0, 0, -9.81]", '[0, 0, "g"]', "task.gravity[2]", "expected a number, got 'g'")
_hand(
    "palm-without-gravity", "gravity = [0, 0, -9.81]", 'palm = { axis = "x", turn = "90 deg" }', "task.palm", "nothing"
)
_hand("no-synergy", "synergies = 4", "synergies = 0", "hand.synergies", "at least 1 synergy")
_hand("half-synergy", "synergies = 4", "synergies = 1.5", "hand.synergies", "a number of synergies")
_hand("coupling-text", "synergies = 4", 'coupling = "a third"', "hand.coupling", "is not a number or a fraction")
_hand("posture-unit", "synergies = 4", "posture = { close = 1.2 }", "hand.posture.close", "1.2 has no unit")
_hand("close-number", "synergies = 4", "close = 1", "hand.close", "expected the name of a synergy or joint")
_hand("close-nothing", "synergies = 4", "close = {}", "hand.close", "weights by name such as { s1 = -1, s2 = 0.2 }")
_hand("close-weight", "synergies = 4", 'close = { s1 = "5 deg" }', "hand.close.s1", "expected a number, got '5 deg'")
_hand("close-weight-nan", "synergies = 4", "close = { s1 = nan }", "hand.close.s1", "nan is not a finite number")
_hand("close-list", "synergies = 4", 'close = ["s1"]', "hand.close", "got a list")
_hand("compliance", "synergies = 4", "compliance = { synergy = -1 }", "hand.compliance.synergy", "at least 0, got -1")
_hand("no-knots", "knots = 11", "knots = 0", "task.knots", "must be at least 1, got 0")
_hand("one-knot", "knots = 11", "knots = 1", "task.knots", "needs at least 2 knots")
_hand("short-duration", '"2 s"', '"1e-4 ms"', "task.duration", "must be at least 1 us, got 0.1 us")
_hand("too-many-digits", "knots = 11", "knots = 1" + "0" * 5000, "", "a number with too many digits")
_hand("too-soft", '"8 N/mm"', '"1e-300 N/mm"', "contacts.stiffness", "is too soft to hold anything")
_hand("pad-name", "finger2/tip", "finger2,tip", "contacts.at[1]", "may not hold commas, quotes or control characters")
_hand("many-knots", "knots = 11", "knots = 1000000", "task.knots", "must be at most 100000")
_hand("real-knots", "knots = 11", "knots = 11.0", "task.knots", "expected a whole number, got 11.0")
_hand("zero-duration", '"2 s"', '"0 s"', "task.duration", "must be greater than 0")
_hand("axis-letter", 'axis = "z"', 'axis = "w"', "task.move[0].axis", "'w' is not 'x', 'y', 'z'")
_hand("axis-of-nothing", 'axis = "z"', "axis = [0, 0, 0]", "task.move[0].axis", "an axis needs a direction")
_hand("move-without-axis", 'axis = "z"', 'profile = "linear"', "task.move[0]", "a move needs axis")
_hand("axis-and-mode", 'axis = "z"', 'axis = "z"\nmode = 1', "task.move[0].mode", "an axis or a mode, not both")
_hand("move-of-nothing", 'lift = "10 mm"', "", "task.move[0]", "needs lift or roll")
_hand(
    "profile",
    'lift = "10 mm"',
    'lift = "1 m"\nprofile = "min-jrek"',
    "task.move[0].profile",
    "did you mean 'min-jerk'?",
)
_hand("move-and-motion", "knots = 11", 'knots = 11\nmotion = "m.csv"', "task.motion", "given already by 'move'")
_hand("wrench-of-two", "knots = 11", "wrench = [1, 2]", "task.wrench", "expected 6 numbers, got 2")
_hand("force-range", '"20 N"', '["3 N", "1 N"]', "limits.normal_force", "the least force 3 N exceeds the largest, 1 N")
_hand("force-range-of-three", '"20 N"', '["3 N", "4 N", "5 N"]', "limits.normal_force", "expected 2 forces, got 3")
_hand("force-range-unit", '"20 N"', '["0 N", "20 m"]', "limits.normal_force[1]", "'m' is a unit of length")
_hand("torque-word", 'margin = "0.5 N"', 'joint_torque = "hnad"', "limits.joint_torque", "expected 'hand', a number")
_hand("torque-list", 'margin = "0.5 N"', "joint_torque = [1, -1]", "limits.joint_torque[1]", "must be greater than 0")
_hand("rate", 'margin = "0.5 N"', "synergy_rate = 0", "limits.synergy_rate", "must be greater than 0")
_hand("two-goals", '"effort"', '"effort"\nmaximise = "margin"', "goal.minimise", "order = ")
_hand("goal-word", '"effort"', '"efort"', "goal.minimise", "did you mean 'effort'?")
_hand(
    "output",
    "[goal]",
    "[output]\nwrite = ['xml']\n[goal]",
    "output.write[0]",
    "'xml' is not one of 'json', 'csv' or 'npz'",
)
_hand("two-grasps", "[goal]", "[grasp]\nfile = 'grasp.json'\n[goal]", "hand", "exclude each other")
_hand("contact-table", "[task]\n", "[contact]\nat = 'a'\n[task]\n", "contact", "expected a list, got a table")
_hand("contact-link", "[task]\n", "[[contact]]\nlink = 5\n[task]\n", "contact[0].link", "expected a string, got 5")
_hand("contact-twice", "[task]\n", "[[contact]]\nat = 'a'\nlink = 'b'\n[task]\n", "contact[0].link", "not both; leave")
_hand(
    "pad-with-point",
    "[task]\n",
    "[[contact]]\nat = 'a'\npoint = ['0 m', '0 m', '0 m']\n[task]\n",
    "contact[0].point",
    "'point' goes with 'link'",
)
_hand(
    "link-point",
    "[task]\n",
    "[[contact]]\nlink = 'a'\npoint = ['0 m', 0, '0 m']\n[task]\n",
    "contact[0].point[1]",
    "0 has no unit; expected a length",
)
_hand(
    "link-normal",
    "[task]\n",
    "[[contact]]\nlink = 'a'\nnormal = '-z'\n[task]\n",
    "contact[0].normal",
    "'-z' is not 'x', 'y', 'z' or a list of 3 numbers",
)
_hand(
    "link-radius",
    "[task]\n",
    "[[contact]]\nlink = 'a'\nradius = '-1 mm'\n[task]\n",
    "contact[0].radius",
    "must be greater than 0",
)
_hand(
    "link-normals-pad",
    "[task]\n",
    "[[contact]]\nlink = 'a'\nnormals = 'pad'\n[task]\n",
    "contact[0].normal",
    "missing key 'normal'",
)
_hand(
    "link-names",
    "[task]\n",
    "[[contact]]\nlink = 'palm'\n[[contact]]\nlink = 'palm'\n[task]\n",
    "contact[1]",
    "two contacts have the name 'palm'; give each of them a name",
)
_hand("contact-at", "[task]\n", "[[contact]]\nfriction = 1\n[task]\n", "contact[0].at", "missing key 'at'")

_add("no-grasp-file", {"problem.toml": MATRICES, "wrench.csv": WRENCH}, "grasp.file", "grasp file")
_add("no-csv", {"problem.toml": MATRICES, "grasp.json": GRASP}, "task.wrench", "CSV file")
_add("json-syntax", {"problem.toml": MATRICES, "grasp.json": "{,}"}, "", "not valid JSON", "grasp.json")
_add("json-list", {"problem.toml": MATRICES, "grasp.json": "[]"}, "", "expected a JSON object", "grasp.json")
_add("json-duplicate", {"problem.toml": MATRICES, "grasp.json": '{"G": 1, "G": 1}'}, "G", "written twice", "grasp.json")
_matrices("nan", _entry("G", 2, 3, float("nan")), "G[2][3]", "not a finite number")
_matrices("infinity", _entry("J", 0, 1, float("-inf")), "J[0][1]", "not a finite number")
_matrices("text", _entry("G", 2, 3, "0.5"), "G[2][3]", "expected a number, got '0.5'")
_matrices("null", _entry("S", 1, 1, None), "S[1][1]", "expected a number, got null")
_matrices("true", _entry("J", 1, 1, True), "J[1][1]", "expected a number, got true")
_matrices("ragged", lambda d: d["G"][4].pop(), "G[4]", "expected 9 numbers in this row, got 8")
_matrices("ragged-synergies", lambda d: d["S"][1].append(1), "S[1]", "expected 2 numbers in this row, got 3")
_matrices("five-rows", lambda d: d["G"].pop(), "G", "expected 6 rows, got 5")
_matrices("columns", lambda d: [row.pop() for row in d["G"]], "G", "got 8 (n_l = 9 follows from 3 hard contacts)")
_matrices("jacobian-rows", lambda d: d["J"].pop(), "J", "expected 9 rows, got 8 (n_l = 9 follows from 3 hard contacts)")
_matrices("synergy-rows", lambda d: d["S"].pop(), "S", "expected 3 rows, got 2")
_matrices("no-columns", lambda d: d.update(S=[[], [], []]), "S", "has no columns")
_matrices("flat", lambda d: d.update(G=[1.0] * 6), "G", "expected a matrix: a list of rows")
_matrices("number-for-matrix", lambda d: d.update(J=1), "J", "expected a matrix")
_matrices("empty-matrix", lambda d: d.update(J=[]), "J", "got no rows")
_matrices("no-jacobian", lambda d: d.pop("J"), "J", "missing key 'J'")
_matrices("no-contact-compliance", lambda d: d.pop("C_s"), "C_s", "missing key 'C_s'")
_matrices("negative-compliance", lambda d: d.update(C_s=-1e-4), "C_s", "must not be negative")
_matrices("asymmetric", _entry("C_q", 0, 1, 0.01), "C_q[1][0]", "entry [1][0] is 0, entry [0][1] is 0.01")
_matrices("indefinite", lambda d: d.update(C_z=[[1, 2], [2, 1]]), "C_z", "its smallest eigenvalue is -1")
_matrices("negative-diagonal", _entry("C_q", 2, 2, -0.02), "C_q[2][2]", "its smallest eigenvalue is -0.02")
_matrices("compliance-size", lambda d: d.update(C_z=[[1]]), "C_z", "expected 2 rows, got 1")
_matrices("compliance-text", lambda d: d.update(C_s="soft"), "C_s", "expected a number or a matrix, got 'soft'")
_matrices("no-contacts-json", lambda d: d.update(contacts=[]), "contacts", "expected at least 1 entry, got 0")
_matrices("negative-friction-json", _contact(friction=-1), "contacts[1].friction", "use kind 'frictionless'")
_matrices("zero-friction-json", _contact(friction=0), "contacts[1].friction", "use kind 'frictionless'")
_matrices("soft-json", _contact(kind="soft"), "contacts[1].spin_friction_m", "missing key 'spin_friction_m'")
_matrices("kind", _contact(kind="sfot"), "contacts[1].kind", "did you mean 'soft'?")
_matrices("normal", _contact(normal=[1, 1, 0]), "contacts[1].normal", "expected a unit vector, got length 1.41421")
_matrices("normal-of-two", _contact(normal=[1, 0]), "contacts[1].normal", "expected 3 numbers, got 2")
_matrices("same-name", _contact(name="C1"), "contacts[1].name", "two contacts have the name 'C1'")
_matrices("comma-in-name", _contact(name="C,2"), "contacts[1].name", "a name may not hold commas")
_matrices("quote-in-name", _contact(name='"C2"'), "contacts[1].name", "a name may not hold commas, quotes")
_matrices("line-in-name", _contact(name="C\n2"), "contacts[1].name", "quotes or control characters, got 'C\\n2'")
_matrices("other-normal", _contact(normal=[0, 1, 0]), "contacts[1].normal", "is 90 deg from the normal force")
_matrices(
    "no-push", lambda d: [row.__setitem__(3, 0) for row in d["G"]], "G", "contact C2 makes no force on the object"
)
_matrices("soft-contacts", lambda d: d.update(C_s=2e9), "C_s", "a compliance of 2e+09 is too large")
_matrices("soft-joints", _entry("C_q", 1, 1, 2e9), "C_q", "a compliance of 2e+09 is too large")
_matrices("unknown-contact-key", _contact(fricton=1), "contacts[1].fricton", "did you mean 'friction'?")
_matrices("unknown-matrix", lambda d: d.update(H=[[1]]), "H", "unknown key 'H'")
_matrices("future-grasp", lambda d: d.update(schema=2, H=1), "schema", "written for schema 2")
_matrices("short-lambda", lambda d: d.update(lambda_0=[1, 2]), "lambda_0", "expected 9 numbers, got 2")
_matrices("balance", lambda d: d.update(lambda_0=[1] * 9, w_0=[0] * 6), "w_0", "w_0 = -G lambda_0 does not hold")
_csv("empty-csv", "", "the file is empty")
_csv("no-lines", WRENCH.split("\n")[0], "no line of numbers")
_csv("semicolons", WRENCH.replace(",", ";"), "separated by commas")
_csv("header", WRENCH.replace("fy_N", "fy_n"), "unknown column 'fy_n'; did you mean 'fy_N'?")
_csv("absent-column", "t_s,fx_N\n0,1\n", "missing columns 'fy_N', 'fz_N'")
_csv("column-twice", WRENCH.replace("fy_N", "fx_N"), "column 'fx_N' is there twice")
_csv("ragged-csv", WRENCH + "2,0,0\n", "expected 7 cells as in the header, got 3")
_csv("nan-csv", WRENCH + "2,0,0,nan,0,0,0\n", "'nan' is not a finite number")
_csv("infinity-csv", WRENCH + "2,0,0,inf,0,0,0\n", "'inf' is not a finite number")
_csv("text-csv", WRENCH + "2,0,0,x,0,0,0\n", "expected a number, got 'x'")
_csv("other-digits-csv", WRENCH + "2,0,0,\u0661,0,0,0\n", "expected a number, got '\u0661'")
_csv("quote-csv", WRENCH + '2,0,0,"1,0,0,0\n', "expected a number, got '\"1'")
_csv("hole-csv", WRENCH + "2,0,0,,0,0,0\n", "expected a number, got nothing")
_csv("huge-csv", WRENCH + "2,0,0,1e200,0,0,0\n", "1e200 is too large")
_csv("unordered", WRENCH + "0.5,0,0,0,0,0,0\n", "times must increase: 0.5 s comes after 1 s")
_csv("repeated-time", WRENCH + "1,0,0,0,0,0,0\n", "times must increase: 1 s is repeated")
_csv("csv-not-utf-8", b"t_s,\xff\n", "not UTF-8")
