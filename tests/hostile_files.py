"""Files that were made to hang, to exhaust the memory or to crash: what is laid out, and the command that meets it.

The same table serves the tests, which run the commands in their own process, and `benchmarks/hostile_files.py`, which
measures whole processes.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

_INTACT = Path(__file__).parent / "data" / "bad_inputs"
HAND, MATRICES, WRENCH, GRASP = (
    (_INTACT / name).read_text(encoding="utf-8") for name in ("hand.toml", "matrices.toml", "wrench.csv", "grasp.json")
)
HAND = HAND.replace("synergies = 4", 'synergies = 4\nposture = "ball"')

Lay = Callable[[Path], object]


@dataclass(frozen=True)
class Hostile:
    """A folder with something hostile in it; ``@`` in the command stands for the folder."""

    name: str
    lay: Lay
    command: tuple[str, ...]
    fragment: str
    """Of the message."""
    file: str = ""
    """That the message names."""


CASES: list[Hostile] = []
PLAN = ("plan", "@/problem.toml", "-o", "@/out")
JSON_PLAN = ("plan", "@/problem.json", "-o", "@/out")
FIT = ("synergies", "fit", "@/postures.csv", "-n", "1")
SHOW = ("synergies", "show", "@/hand.xml")
SHOW_URDF = ("synergies", "show", "@/hand.urdf")
SHOW_FOLDER = ("synergies", "show", "@/hand")
SHOW_SET = ("synergies", "show", "barrett", "--set", "@/set.toml")


def add(name: str, lay: Lay, command: tuple[str, ...], fragment: str, file: str = "") -> None:
    CASES.append(Hostile(name, lay, command, fragment, file))


def write(folder: Path, name: str, content: str | bytes) -> None:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode("utf-8", "surrogatepass") if isinstance(content, str) else content)


def text(name: str, content: Callable[[], str | bytes], **others: str) -> Lay:
    """Return what writes a file and the others."""

    def lay(folder: Path) -> None:
        for other, intact in others.items():
            write(folder, other.replace("__", "/").replace("_", "."), intact)
        write(folder, name, content())

    return lay


def link(name: str, target: str, **others: str) -> Lay:
    """Return what makes a link and the other files; the target ``pipe`` is a FIFO in the folder."""

    def lay(folder: Path) -> None:
        text("intact.txt", lambda: "", **others)(folder)
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        if target == "pipe":
            os.mkfifo(folder / name)
        else:
            (folder / name).symlink_to(target)

    return lay


def _problem(name: str, change: Callable[[], str | bytes], fragment: str) -> None:
    add(name, text("problem.toml", change), PLAN, fragment, "problem.toml")


def _grasp(name: str, change: Callable[[], str | bytes], fragment: str) -> None:
    lay = text("grasp.json", change, problem_toml=MATRICES, wrench_csv=WRENCH)
    add(f"grasp-{name}", lay, PLAN, fragment, "grasp.json")


def _csv(name: str, change: Callable[[], str | bytes], fragment: str) -> None:
    lay = text("wrench.csv", change, problem_toml=MATRICES, grasp_json=GRASP)
    add(f"csv-{name}", lay, PLAN, fragment, "wrench.csv")


def _data(**changes: Any) -> str:
    return json.dumps({**json.loads(GRASP), **changes})


def _large(n_q: int) -> str:
    """Return a grasp of which only the joint compliance is wrong, and only by its eigenvalues."""
    rows = np.random.default_rng(0).normal(size=(n_q, n_q))
    C_q = np.round(rows + rows.T, 6) + np.eye(n_q)
    np.fill_diagonal(C_q, 1.0)
    return _data(J=rows[:9].tolist(), S=rows[:, :2].tolist(), C_q=C_q.tolist())


def _changed(old: str, new: str) -> str:
    if HAND.count(old) != 1:
        raise ValueError(f"{old!r} must stand once in the problem")
    return HAND.replace(old, new)


HAND_FILE = 'schema = 1\ntitle = "x"\nmodel = "hand.urdf"\n[[joint]]\nname = "j"\n'

# What is no plain file, wherever a file is named.
PLACES = [
    ("problem", "problem.toml", PLAN, {}),
    ("json-problem", "problem.json", JSON_PLAN, {}),
    ("grasp", "grasp.json", PLAN, {"problem_toml": MATRICES, "wrench_csv": WRENCH}),
    ("csv", "wrench.csv", PLAN, {"problem_toml": MATRICES, "grasp_json": GRASP}),
    ("postures", "postures.csv", FIT, {}),
    ("mjcf", "hand.xml", SHOW, {}),
    ("urdf", "hand.urdf", SHOW_URDF, {}),
    (
        "hand-model",
        "hand/hand.urdf",
        SHOW_FOLDER,
        {"hand__hand_toml": HAND_FILE},
    ),
    ("synergies", "set.toml", SHOW_SET, {}),
    ("plan-json", "plan.json", ("check", "@/plan.json", "barrett-ball-hold"), {}),
    ("export-json", "plan.json", ("export", "@/plan.json", "--to", "csv"), {}),
    ("plan-npz", "plan.npz", ("check", "@/plan.npz", "barrett-ball-hold"), {}),
    ("plan-csv", "plan.csv", ("check", "@/plan.csv", "barrett-ball-hold"), {}),
    ("include", "part.xml", SHOW, {"hand_xml": '<mujoco><include file="part.xml"/></mujoco>'}),
    ("attached", "part.xml", SHOW, {"hand_xml": '<mujoco><asset><model name="m" file="part.xml"/></asset></mujoco>'}),
]
for _name, _file, _command, _others in PLACES:
    add(f"{_name}-is-a-pipe", link(_file, "pipe", **_others), _command, "is a pipe; expected a", _file)
    add(f"{_name}-leads-to-a-device", link(_file, "/dev/zero", **_others), _command, "is a device; expected a", _file)
add("terminal", link("problem.toml", "/dev/tty"), PLAN, "is a device; expected a problem file", "problem.toml")
add("circle-of-links", link("problem.toml", "problem.toml"), PLAN, "cannot be read", "problem.toml")
add("link-to-a-folder", link("problem.toml", "."), PLAN, "is a directory", "problem.toml")
add("memory-of-the-process", link("problem.toml", "/proc/self/mem"), PLAN, "cannot be read", "problem.toml")
add("file-of-the-system", link("problem.toml", "/proc/self/environ"), PLAN, "", "problem.toml")
add("size-0-in-proc", link("postures.csv", "/proc/self/maps"), FIT, "", "postures.csv")
add("long-name-of-a-problem", text("x", lambda: ""), ("plan", "x" * 5000), "no such file")
add("long-name", text("x.toml", lambda: ""), ("plan", "@/" + "x" * 5000 + ".toml"), "File name too long")
add(
    "long-name-of-a-plan",
    text("x", lambda: ""),
    ("check", "@/" + "x" * 5000 + ".npz", "barrett-ball-hold"),
    "there is no file",
)


def _sparse(name: str, size: int, **others: str) -> Lay:
    def lay(folder: Path) -> None:
        text(name, lambda: "", **others)(folder)
        os.truncate(folder / name, size)

    return lay


add("sparse-terabyte", _sparse("problem.toml", 10**12), PLAN, "is larger than 32 MB", "problem.toml")
add("zeros-as-toml", _sparse("problem.toml", 31_000_000), PLAN, "is longer than 1,000,000 characters", "problem.toml")
add("zeros-as-json", _sparse("problem.json", 31_000_000), JSON_PLAN, "not valid JSON", "problem.json")
add("zeros-as-csv", _sparse("postures.csv", 31_000_000), FIT, "", "postures.csv")
add("zeros-as-xml", _sparse("hand.xml", 15_000_000), SHOW, "not XML", "hand.xml")
add("sparse-xml", _sparse("hand.xml", 10**10), SHOW, "is larger than 16 MB", "hand.xml")
add(
    "zeros-as-npz",
    _sparse("plan.npz", 31_000_000),
    ("check", "@/plan.npz", "barrett-ball-hold"),
    "no .npz archive",
    "plan.npz",
)

# TOML
_problem("unknown-keys", lambda: HAND + "\n[more]\n" + "".join(f"key{i} = 1\n" for i in range(20_000)), "unknown key")
_problem("unknown-keys-at-the-top", lambda: "".join(f"gaol{i} = 1\n" for i in range(20_000)), "unknown key")
_problem("unknown-tables", lambda: HAND + "".join(f"[limits{i}]\n" for i in range(20_000)), "unknown key")
_problem("many-keys", lambda: "".join(f"k{i} = 1\n" for i in range(60_000)), "more than 50,000 keys and values")
_problem("long-list", lambda: HAND + "\n[more]\nx = [" + "1," * 400_000 + "]\n", "more than 50,000 keys and values")
_problem("list-of-tables", lambda: HAND + "[[contact]]\n" * 24_000, "missing")
_problem("contact-tables", lambda: HAND + "[[contact]]\nat = 'finger1/tip'\n" * 9000, "at most 250 entries")
_problem("waypoints", lambda: HAND + "".join(f"[[task.waypoint]]\ntime = '{i + 1} ms'\n" for i in range(9000)), "")
_problem("moves", lambda: HAND + "[[task.move]]\naxis = 'w'\n" * 9000, "'w' is not")
_problem("pushes", lambda: HAND + "[[task.push]]\nforce = 1\n" * 9000, "task.push")
_problem("pads", lambda: _changed('"finger2/tip"', '"finger2/tip",' * 40_000 + '"finger2/tip"'), "at most 250 entries")
_problem("other-pads", lambda: _changed('"finger2/tip"', ",".join(f'"finger{i}/tip"' for i in range(9000))), "finger")
_problem("dotted-key", lambda: HAND + "[more]\n" + "a." * 400_000 + "b = 1\n", "nested too deeply")
_problem("dotted-table", lambda: HAND + "[" + "a." * 400_000 + "b]\n", "nested too deeply")
_problem("dotted-key-with-quotes", lambda: HAND + "[more]\n" + '"a" . ' * 150_000 + "b = 1\n", "nested too deeply")
_problem("dotted-key-inline", lambda: HAND + "[more]\nx = {" + "a." * 400_000 + "b = 1}\n", "nested too deeply")
_problem("nested-lists", lambda: HAND + "[more]\nx = " + "[" * 20_000, "nested too deeply")
_problem("nested-tables", lambda: HAND + "[more]\nx = " + "{a=" * 20_000, "nested too deeply")
_problem("long-line", lambda: HAND + "[more]\n" + "x" * 900_000 + " = 1\n", "unknown key")
_problem("long-value", lambda: _changed('"0.5 N"', '"' + "x" * 900_000 + '"'), "is not a force")
_problem("blank-quantity", lambda: _changed('"0.5 N"', '"1' + " " * 900_000 + 'x"'), "is not a force")
_problem("long-pad", lambda: _changed('"finger2/tip"', '"' + "x" * 900_000 + '"'), "a name has at most 500 characters")
_problem("long-hand", lambda: _changed('"barrett"', '"' + "x/" * 400_000 + '"'), "neither a bundled hand")
_problem("hand-of-dots", lambda: _changed('"barrett"', '"' + "../" * 300_000 + 'hand.xml"'), "")
_problem("integer", lambda: _changed("knots = 11", "knots = " + "1" * 100_000), "too many digits")
_problem("integers", lambda: HAND + "[more]\nx = [" + ("1" * 4000 + ",") * 200 + "1" * 5000 + "]", "too many digits")
_problem("underscores", lambda: _changed("knots = 11", "knots = 1" + "_1" * 100_000), "too many digits")
_problem("hexadecimal", lambda: _changed("knots = 11", "knots = 0x" + "f" * 900_000), "the number is too large")
_problem("digits", lambda: _changed("friction = 0.6", "friction = 0." + "6" * 900_000 + "e1000"), "not a finite number")
_problem("knots", lambda: _changed("knots = 11", "knots = 1000000000"), "must be at most 100000")
_problem("years", lambda: _changed('"2 s"', '"1e300 s"'), "")
_problem("nul", lambda: HAND.replace("barrett", "bar\0rett"), "not valid TOML")
_problem("escaped-nul", lambda: _changed('"barrett"', '"bar\\u0000rett.xml"'), "")
_problem("utf-16", lambda: HAND.encode("utf-16"), "not UTF-8")
_problem("utf-32", lambda: HAND.encode("utf-32"), "not UTF-8")
_problem("latin-1", lambda: b"#" + b" " * 900_000 + "title = 'größe'".encode("latin-1"), "not UTF-8")
_problem("overlong-utf-8", lambda: b"title = '\xc0\x80'", "not UTF-8")
_problem("surrogate", lambda: "title = '\ud800'", "not UTF-8")
_problem("three-marks", lambda: "\ufeff\ufeff\ufeff" + HAND, "not valid TOML")
_problem("unclosed-text", lambda: HAND + '[more]\nx = """' + "\n" * 900_000, "not valid TOML")
_problem("twice-then-anything", lambda: HAND + "[goal]\n" + "{[" * 20_000, "written twice")
_problem("twice-and-long", lambda: HAND + "[more]\n" + ('"' + " " * 400_000 + '"=1\n') * 2, "twice")
_problem("many-twice", lambda: HAND + "[task]\n" * 20_000, "written twice")
_problem("carriage-returns", lambda: "\r" * 900_000, "not valid TOML")
_problem("wide-and-long", lambda: HAND + '[more]\nx = ["\U0001f600"' + ', "é"' * 40_000 + "]\ny = nan\n", "")

# JSON
add(
    "json-unknown-keys",
    text("problem.json", lambda: json.dumps({f"k{i}": 1 for i in range(20_000)})),
    JSON_PLAN,
    "unknown",
    "problem.json",
)
add("json-nested", text("problem.json", lambda: "[" * 40_000), JSON_PLAN, "nested too deeply", "problem.json")
add(
    "json-many",
    text("problem.json", lambda: '{"x": [' + "0," * 10_000_000 + "0]}"),
    JSON_PLAN,
    "more than 2,000,000 numbers",
    "problem.json",
)
_grasp("500-by-500", lambda: _data(C_q=np.eye(500).tolist()), "C_q")
_grasp("J-500-by-500", lambda: _data(J=np.ones((500, 500)).tolist(), S=np.ones((500, 500)).tolist()), "J")
_grasp(
    "all-500-by-500",
    lambda: _data(**{k: np.ones((500, 500)).tolist() for k in ("G", "J", "S", "C_s", "C_q", "C_z")}),
    "G",
)
_grasp(
    "1500-by-1500",
    lambda: '{"G": [' + ",".join(["[" + "0," * 1499 + "0]"] * 1500) + "]}",
    "more than 2,000,000 numbers",
)
_grasp("wide-text-in-a-row", lambda: _data(G=[["é", "\U0001f600"] * 5000] * 2), "G")
_grasp("largest-indefinite", lambda: _large(1000), "is not positive semidefinite")
_grasp("too-large", lambda: _large(1001), "is larger than 1000 rows or columns")
_grasp("many-numbers", lambda: '{"G": [' + "0," * 8_000_000 + "0]}", "more than 2,000,000 numbers")
_grasp("many-empty-lists", lambda: '{"G": [' + "[]," * 900_000 + "0]}", "500,000 lists")
_grasp("many-keys", lambda: "{" + ",".join(f'"k{i}":0' for i in range(200_000)) + "}", "50,000 keys")
_grasp("unknown-keys", lambda: _data(**{f"k{i}": 0 for i in range(20_000)}), "unknown key")
_grasp("infinities", lambda: _data(G=[[float("inf")] * 40_000] * 6), "not a finite number")
_grasp("texts", lambda: _data(G=[["x"] * 100_000] * 6), "G")
_grasp("numbers-of-4000-digits", lambda: '{"G": [' + ("7" * 4200 + ",") * 5000 + "7" * 5000 + "]}", "too many digits")
_grasp("number-of-30-million-digits", lambda: '{"G": ' + "7" * 30_000_000 + "}", "too many digits")
_grasp("exponent", lambda: '{"G": 1e' + "9" * 1_000_000 + "}", "not a finite number")
_grasp("contacts", lambda: _data(contacts=[{}] * 20_000), "contacts")
_grasp("same-contacts", lambda: _data(contacts=json.loads(GRASP)["contacts"] * 3000), "contacts")
_grasp("names", lambda: _data(title="x" * 20_000_000, H=1), "unknown key")
_grasp("kind", lambda: _data(contacts=[{"name": "x", "kind": "z" * 5_000_000}]), "is not one of")
_grasp("surrogate", lambda: _data(contacts=[{"name": "\ud800", "kind": "\udfff"}]), "expected text")
_grasp(
    "nested-lists", lambda: _data().replace('"G": [', '"H": ' + "[" * 500 + "]" * 500 + ', "G": ['), "nested too deeply"
)
_grasp("unclosed", lambda: GRASP.rstrip().rstrip("}") + "," * 1_900_000, "not valid JSON")
_grasp("unclosed-text", lambda: '{"G": "' + "\\u0041" * 5_000_000, "not valid JSON")
_grasp("newlines", lambda: "\n" * 30_000_000 + "x", "not valid JSON")
_grasp("invalid-at-the-end", lambda: GRASP.encode() + b" " * 30_000_000 + b"\xff", "not UTF-8")
_grasp("key-twice", lambda: '{"G": 1, "G": 2, "J": [' + "0," * 1_900_000 + "0]}", "written twice")

# CSV
_csv("100000-columns", lambda: ",".join(f"c{i}" for i in range(100_000)) + "\n", "at most 5,000 columns")
_csv("10-million-columns", lambda: "," * 10_000_000, "cells")
_csv("5000-columns", lambda: ",".join(f"fx_n{i}" for i in range(4990)) + "\n", "unknown column")
_csv("same-columns", lambda: ",".join(["fx_N"] * 4990) + "\n", "is there twice")
_csv("lines", lambda: WRENCH + "\n" * 30_000_000, "more than 100,000 lines")
_csv("one-line", lambda: WRENCH.replace("\n", " ") * 400_000, "cells")
_csv("no-numbers", lambda: WRENCH + "x,x,x,x,x,x,x\n" * 95_000, "expected a number, got 'x'")
_csv("ragged", lambda: WRENCH + "0,0\n" * 95_000, "expected 7 cells")
_csv("one-wide-line", lambda: WRENCH + "0," * 1_900_000 + "\n", "expected 7 cells")
_csv("backwards", lambda: WRENCH + "".join(f"{-i},0,0,0,0,0,0\n" for i in range(95_000)), "times must increase")
_csv("digits", lambda: WRENCH + "2," + "1" * 10_000_000 + ",0,0,0,0,0\n", "not a finite number")
_csv("quotes", lambda: '"' * 20_000_000, "header")
_csv("nul", lambda: WRENCH.replace("fx", "f\0x"), "unknown column")
_csv("utf-16", lambda: WRENCH.encode("utf-16"), "not UTF-8")
_csv("carriage-returns", lambda: WRENCH.replace("\n", "\r") * 200, "column")
_csv("separators", lambda: ";" * 20_000_000, "separated by commas")
_csv("blanks", lambda: " " * 30_000_000, "the file is empty")
_csv("remarks", lambda: "#\n" * 99_000, "the file is empty")


def _two_tables(folder: Path) -> None:
    """Lay out a wrench and a motion whose lines are at different times, and each of them a knot."""
    wrench, motion = ("".join(f"{i}{half},0,0,0,0,0,0\n" for i in range(2, 59_999)) for half in ("", ".5"))
    wrench, motion = (table + "59999,0,0,0,0,0,0\n" for table in (wrench, motion))
    write(folder, "problem.toml", MATRICES.replace("knots = 2", 'motion = "motion.csv"'))
    write(folder, "grasp.json", GRASP)
    write(folder, "wrench.csv", WRENCH + wrench)
    write(folder, "motion.csv", "t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad\n0,0,0,0,0,0,0\n" + motion)


add("csv-too-many-knots", _two_tables, PLAN, "knots; at most 100000", "problem.toml")
add(
    "postures-100000-columns",
    text("postures.csv", lambda: ",".join(f"j{i}" for i in range(100_000)) + "\n"),
    FIT,
    "at most 2000",
    "postures.csv",
)
add(
    "postures-no-numbers",
    text("postures.csv", lambda: "a,b\n" + "x,y\n" * 95_000),
    FIT,
    "no joint values",
    "postures.csv",
)
add(
    "postures-of-a-hand",
    text("postures.csv", lambda: ",".join(f"joint{i}" for i in range(4990))),
    (*FIT, "--hand", "barrett"),
    "joint",
    "postures.csv",
)
