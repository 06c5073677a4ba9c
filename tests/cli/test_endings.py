"""How a process ends: output that fails, and interrupts at every moment from the first import to the last word."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from synergrip.scratch import NAME

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals and streams of POSIX")
FILES = {"plan.json", "plan.csv", "plan.npz"}
KEPT = "written and kept: " + ", ".join(f"out/pinch-soft/plan.{suffix}" for suffix in ("json", "csv", "npz"))
PLAN = ("plan", "pinch-soft")


def shell(line: str) -> subprocess.CompletedProcess[str]:
    """Run a line of the shell, in which SYNERGRIP is the program."""
    line = line.replace("SYNERGRIP", f"{sys.executable} -m synergrip")
    return subprocess.run(
        ["bash", "-c", f"set -o pipefail; {line}"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )


def written() -> set[str]:
    """Return the names of what stands in the folder of the plan; hidden files must not be left anywhere."""
    assert not [path for path in Path().rglob("*") if NAME.fullmatch(path.name)]
    return {path.name for path in Path("out/pinch-soft").glob("*")}


# Standard output


@pytest.mark.parametrize(
    ("end", "reason"),
    [("| sleep 0", "its reader has gone"), ("--format json > /dev/full", "No space left on device"),
     (">&-", "it is closed"), ("--format json <&- >&-", "it is closed")],
)  # fmt: skip
def test_an_answer_that_cannot_be_printed_is_exit_code_5_and_its_files_stand(end: str, reason: str) -> None:
    done = shell(f"SYNERGRIP plan pinch-soft {end}")
    assert done.returncode == 5, done
    lines = done.stderr.splitlines()
    assert lines[0] == f"error: the answer could not be printed on standard output: {reason}"
    assert lines[-1] == f"{KEPT}      exit code 5"
    assert "report" not in done.stderr
    assert written() == FILES
    assert json.loads(Path("out/pinch-soft/plan.json").read_text(encoding="utf-8"))["verdict"] == "feasible"


@pytest.mark.parametrize(
    "line",
    ["--help | sleep 0", "plan --help > /dev/full", "--version >&-", "schema > /dev/full",
     "plan nonsense --format json > /dev/full"],
)  # fmt: skip
def test_so_is_everything_else_that_is_printed(line: str) -> None:
    done = shell(f"SYNERGRIP {line}")
    assert done.returncode == 5, done
    assert done.stderr.startswith("error: the answer could not be printed on standard output: ")
    assert done.stderr.endswith("exit code 5\n")
    assert len(done.stderr.splitlines()) <= 3


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("plan nonsense 2>&-", 2),
        ("plan --nonsense 2> /dev/full", 2),
        ("plan pinch-hard --picture p.svg --format json 2>&-", 1),
        ("plan pinch-hard --picture p.svg --format json 2> /dev/full", 1),
        ("plan pinch-soft > /dev/full 2>&-", 5),
        ("plan pinch-soft >&- 2>&-", 5),
    ],
)
def test_messages_that_nobody_hears_change_nothing(line: str, code: int) -> None:
    done = shell(f"SYNERGRIP {line}")
    assert (done.returncode, done.stderr) == (code, "")
    if "json" in line:
        assert json.loads(done.stdout)["verdict"] == "infeasible"
    else:
        assert done.stdout == ""


def test_a_slow_reader_gets_everything() -> None:
    """Also from a pipe that does not wait, as some programs leave it to those they start."""
    pipe, end = os.pipe()
    os.set_blocking(end, False)
    arguments = ("plan", "barrett-ball-hold", "--format", "json", "--set", "task.knots=61")
    with subprocess.Popen([sys.executable, "-m", "synergrip", *arguments], stdout=end) as run:
        os.close(end)
        time.sleep(3)
        with open(pipe, encoding="utf-8") as stream:
            text = stream.read()
        assert run.wait() == 0
    assert len(text) > 2**16  # more than a pipe holds
    assert json.loads(text)["verdict"] == "feasible"


# Files


def test_a_plan_json_that_is_a_folder_loses_nothing_and_is_told_before_solving() -> None:
    assert shell("SYNERGRIP plan pinch-soft").returncode == 0
    Path("out/pinch-soft/plan.json").unlink()
    Path("out/pinch-soft/plan.json/mine").mkdir(parents=True)
    before = {name: Path("out/pinch-soft", name).read_bytes() for name in FILES - {"plan.json"}}
    done = shell("SYNERGRIP plan pinch-soft --set 'limits.margin=1 N'")
    assert done.returncode == 5
    assert "cannot write 'out/pinch-soft': 'plan.json' is there, and it is a folder" in done.stderr
    assert {name: Path("out/pinch-soft", name).read_bytes() for name in before} == before
    assert Path("out/pinch-soft/plan.json/mine").is_dir()


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_may_not_be_written_is_told_before_solving() -> None:
    Path("out").mkdir(mode=0o500)
    done = shell("SYNERGRIP plan pinch-soft")
    assert done.returncode == 5
    assert "cannot write 'out/pinch-soft': 'out' may not be written" in done.stderr


@pytest.mark.parametrize("option", ["-o", "--picture", "--save-program"])
def test_a_place_that_takes_no_files_is_exit_code_5_and_the_answer_is_shown(option: str) -> None:
    place = "/proc/nothing" + ("" if option == "-o" else ".svg")
    if not Path("/proc/self").exists():
        pytest.skip("no /proc")
    done = shell(f"SYNERGRIP plan pinch-soft {option} {place}")
    assert done.returncode == 5, done
    assert f"cannot write '{place}': " in done.stderr
    assert "feasible  smallest slip margin" in done.stdout
    assert written() == (set() if option == "-o" else FILES)
    assert done.stderr.endswith(f"{'nothing was written' if option == '-o' else KEPT}      exit code 5\n")


def test_a_device_is_no_picture() -> None:
    Path("null.svg").symlink_to(os.devnull)
    done = shell("SYNERGRIP plan pinch-soft --picture null.svg")
    assert done.returncode == 2
    assert "cannot write 'null.svg': it is a device or a pipe and no file" in done.stderr
    assert not Path("out").exists()


# Interrupts


AT = """
import os, signal, sys
def hook(event, arguments):
    global event_, argument
    if event == event_ and str(arguments[0]).endswith(argument):
        event_ = None
        {what}
event_, argument = {event!r}, {argument!r}
sys.addaudithook(hook)
{before}
from synergrip.cli import main
sys.argv[0] = "synergrip"
main()
"""
INTERRUPT = "signal.raise_signal(signal.SIGINT)"


def interrupted(
    event: str, argument: str, arguments: Sequence[str], before: str = "", what: str = INTERRUPT
) -> subprocess.CompletedProcess[str]:
    """Run the program, interrupted at the first event that Python tells of."""
    code = AT.format(what=what, event=event, argument=argument, before=before)
    return subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False)


EARLY = ("synergrip.errors", "typer", "synergrip.planning.planning", "numpy", "scipy.sparse._base", "pydantic")


@pytest.mark.parametrize("module", EARLY)
def test_an_interrupt_while_something_loads_is_one_line(module: str) -> None:
    done = interrupted("import", module, PLAN)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted; nothing was written\n")
    assert written() == set()


@pytest.mark.parametrize("module", ["mujoco._structs", "clarabel.clarabel"])
@pytest.mark.parametrize("form", [(), ("--format", "json")])
def test_so_is_one_while_a_compiled_library_loads(module: str, form: Sequence[str]) -> None:
    done = interrupted("import", module, ("plan", "barrett-ball-hold", *form))
    assert done.returncode == 130
    if form:
        error = json.loads(done.stdout)["error"]
        assert (error["type"], error["message"]) == ("InterruptError", "interrupted; nothing was written")
        assert done.stderr == ""
    else:
        assert done.stdout == ""
        assert done.stderr == "interrupted; nothing was written\n"
    assert not Path("out").exists()


@pytest.mark.parametrize("module", ["cvxpy", "scipy.optimize", "osqp"])
def test_so_is_one_while_the_other_solver_loads(module: str) -> None:
    done = interrupted("import", module, (*PLAN, "--solver", "cvxpy"))
    assert (done.returncode, done.stdout) in ((130, ""), (0, done.stdout))
    assert len(done.stderr.splitlines()) <= 1
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("form", [(), ("--format", "json")])
def test_an_interrupt_along_the_motion_tells_how_far_it_had_come(form: Sequence[str]) -> None:
    passing = f"from synergrip.planning.walk import Walker\nWalker._passed = lambda *_: {INTERRUPT}"
    done = interrupted("none", "", ("plan", "human-ball", "--set", "task.knots=5", *form), before=passing)
    told = json.loads(done.stdout)["error"]["message"] if form else done.stderr
    assert done.returncode == 130
    assert told.startswith("interrupted; after 0 passes along the motion, at the true equilibrium limits are missed: ")
    assert told.rstrip().endswith("; nothing was written")
    assert len(told.splitlines()) == 1
    assert written() == set()


TIGHT = ("plan", "tripod", "--set", 'limits.normal_force="1 N"')
AT_CHANGES = """
import synergrip.explain.explained, synergrip.explain.repairs as repairs
own, count = repairs.outcome_at, 0
def outcome_at(*arguments):
    global count
    count += 1
    if count > {kept}:
        signal.raise_signal(signal.SIGINT)
    return own(*arguments)
repairs.outcome_at = outcome_at
if {kept} < 0:
    synergrip.explain.explained.solved = synergrip.explain.explained.dials = outcome_at
"""


@pytest.mark.parametrize("kept", [-1, 0, 2])
@pytest.mark.parametrize("form", [(), ("--format", "json")])
def test_an_interrupt_while_changes_are_looked_for_keeps_the_answer_and_says_so(kept: int, form: Sequence[str]) -> None:
    done = interrupted("none", "", (*TIGHT, *form), before=AT_CHANGES.format(kept=kept))
    note = "interrupted: changes were not looked for to the end"
    document = json.loads(Path("out/tripod/plan.json").read_text(encoding="utf-8"))
    assert (done.returncode, done.stderr) == (130, "")
    assert (document["exit_code"], document["interrupted"], document["notes"]) == (130, True, [note])
    assert (document["verdict"], len(document["repairs"])) == ("infeasible", max(kept, 0))
    if form:
        assert json.loads(done.stdout) == document
    else:
        assert f"\nnote     {note}\n" in done.stdout
        assert ("What would help" in done.stdout) == (kept > 0)
        assert "no single change" not in done.stdout  # not all of them were looked at
        assert done.stdout.endswith("wrote out/tripod/  plan.json      exit code 130\n")


@pytest.mark.parametrize(("name", "signal_"), [("plan.json", signal.SIGINT), ("plan.npz", signal.SIGTERM)])
def test_a_signal_while_files_are_written_waits_until_they_stand(name: str, signal_: signal.Signals) -> None:
    assert shell("SYNERGRIP plan pinch-soft").returncode == 0
    before = Path("out/pinch-soft", name).read_bytes()
    arguments = (*PLAN, "--set", "limits.margin=1 N")
    done = interrupted("open", name, arguments, what=f"signal.raise_signal({signal_.value})")
    assert done.returncode == (130 if signal_ is signal.SIGINT else -signal.SIGTERM)
    assert done.stderr == (f"interrupted; {KEPT}\n" if signal_ is signal.SIGINT else "")
    assert done.stdout == ""
    assert written() == FILES
    assert Path("out/pinch-soft", name).read_bytes() != before


def test_an_interrupt_while_a_picture_is_drawn_keeps_the_plan() -> None:
    done = interrupted("import", "matplotlib.figure", (*PLAN, "--picture", "p.svg"))
    assert (done.returncode, done.stdout, done.stderr) == (130, "", f"interrupted; {KEPT}\n")
    assert written() == FILES
    assert not Path("p.svg").exists()


def test_an_interrupt_when_all_is_said_is_no_traceback() -> None:
    done = interrupted("none", "", PLAN, before=f"import atexit; atexit.register(lambda: {INTERRUPT})")
    assert (done.returncode, done.stderr) in ((0, ""), (130, f"interrupted; {KEPT}\n"))
    late = "import sys\nclass Late:\n    def __del__(self, raise_=signal.raise_signal): raise_(2)\nlate = Late()"
    done = interrupted("none", "", PLAN, before=late)
    assert (done.returncode, done.stderr) == (0, "")


DESTRUCTOR = """
class Falls:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)
def planning(*_):
    Falls()
    for _ in range(10**6):
        pass
    print("never", file=sys.stderr)
import synergrip.planning.planning
synergrip.planning.planning.plan = planning
"""


def test_an_interrupt_that_falls_into_a_destructor_is_heard() -> None:
    done = interrupted("none", "", PLAN, before=DESTRUCTOR)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted; nothing was written\n")


TURNED = """
def planning(*_):
    try:
        signal.raise_signal(signal.SIGINT)
    except BaseException:
        raise ImportError("initialization failed")
import synergrip.planning.planning
synergrip.planning.planning.plan = planning
"""


def test_an_interrupt_that_a_library_turns_into_another_error_is_one() -> None:
    done = interrupted("none", "", PLAN, before=TURNED)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted; nothing was written\n")


IN_C = """
import ctypes
run = ctypes.PYFUNCTYPE(ctypes.py_object, ctypes.c_char_p, ctypes.c_int, ctypes.py_object, ctypes.py_object)
run = run(("PyRun_String", ctypes.pythonapi))
def planning(*_):
    run(b"import signal\\nsignal.raise_signal(2)\\n", 257, {"__builtins__": __builtins__}, {})
import synergrip.planning.planning
synergrip.planning.planning.plan = planning
"""


def test_an_interrupt_that_passed_through_the_interpreter_in_c_is_no_death_by_the_signal() -> None:
    """Python started with -m, which heeds that when it ends."""
    code = AT.format(what=INTERRUPT, event="none", argument="", before=IN_C)
    Path("started.py").write_text(code, encoding="utf-8")
    done = subprocess.run([sys.executable, "-m", "started", *PLAN], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted; nothing was written\n")


def test_an_interrupt_while_the_command_line_itself_loads_is_one_line() -> None:
    code = AT.format(what=INTERRUPT, event="import", argument="synergrip.cli", before="")
    code = code.split("from synergrip.cli")[0] + "import runpy; runpy.run_module('synergrip', run_name='__main__')"
    done = subprocess.run([sys.executable, "-c", code, "problems"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted; nothing was written\n")


def test_who_was_told_to_ignore_interrupts_does(tmp_path: Path) -> None:
    done = interrupted("import", "numpy", PLAN, before="signal.signal(signal.SIGINT, signal.SIG_IGN)")
    assert done.returncode == 0
    assert written() == FILES


def test_an_interrupt_keeps_the_points_of_a_front_that_are_finished() -> None:
    before = """
import synergrip.cli.front as front, synergrip.margin.front as points
own = points.front
def some(*arguments):
    for count, point in enumerate(own(*arguments)):
        yield point
        if count == 1:
            signal.raise_signal(signal.SIGINT)
points.front = some
"""
    done = interrupted("none", "", ("front", "pinch-soft", "--format", "json"), before=before)
    assert (done.returncode, done.stderr) == (130, "")
    found: dict[str, Any] = json.loads(done.stdout)
    assert found["interrupted"] is True
    assert len(found["front"]) in (1, 2)
