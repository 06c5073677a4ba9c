"""The front of the exports: which formats there are, what each leaves empty, and writing them all or none."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, Issue, one_of, raise_issues
from synergrip.files import refuse_unwritable_folder
from synergrip.log import LOG
from synergrip.planning.outcome import Plan
from synergrip.reports.data.exports.exported_plan import KEY, NO_HAND, ExportedPlan, exported_plan
from synergrip.reports.data.exports.grasp_files import write_isaac_grasp, write_moveit_grasp
from synergrip.reports.data.exports.joint_trajectories import write_mcap, write_ros2_yaml
from synergrip.reports.data.exports.mjcf_keyframes import write_mjcf
from synergrip.reports.data.exports.tables import write_csv, write_npz, write_parquet
from synergrip.reports.data.saving import path_of, written_at
from synergrip.together import refuse_others, replace_together

Write = Callable[[ExportedPlan, Path], None]


class Empty(NamedTuple):
    """A field of a format of which a plan knows nothing."""

    field: str
    why: str


JUMP = "references go straight between the knots, so that these jump there"
MASSES = "the plan knows no masses of links: MuJoCo takes 1e-6 kg and 1e-9 kg m^2 for each"
QUALITY = "how likely the grasp succeeds was not asked; 0 stands there for nothing"
OPEN = "the plan begins where the hand touches; an open hand before that is not in it"
APPROACH = "the plan knows no way of the arm"
COMMANDS = "controllers of positions refuse trajectories with efforts"
_MESSAGE = (
    Empty("velocities, accelerations", JUMP), Empty("effort of joint_references and synergies", COMMANDS),
    Empty("header.stamp", "a trajectory without one begins at once"),
)  # fmt: skip


@dataclass(frozen=True)
class Exporter:
    """A format."""

    files: tuple[str, ...]
    """All that it may write."""
    write: Write
    """Writes them into a folder."""
    package: str = ""
    """What it takes beside what synergrip brings."""
    module: str = ""
    of_hand: str = ""
    """What of it only a hand has; empty where a grasp given as matrices has it, too."""
    empty: tuple[Empty, ...] = ()
    joints_of_hand: bool = False
    """Whether joints are left out where no hand says where they are."""


def _one(name: str, write: Write, **others: Any) -> Exporter:
    return Exporter((name,), lambda plan, folder: write(plan, folder / name), **others)


_YAML = {"package": "PyYAML", "module": "yaml"}
EXPORTERS = {
    "csv": _one("trajectory.csv", write_csv),
    "npz": _one("trajectory.npz", write_npz),
    "parquet": _one("trajectory.parquet", write_parquet, package="pyarrow", module="pyarrow"),
    "ros2-yaml": Exporter(
        ("joints.yaml", "joint_references.yaml", "synergies.yaml"), write_ros2_yaml, **_YAML, empty=_MESSAGE,
        joints_of_hand=True,
    ),
    "mcap": Exporter(
        ("trajectory.mcap", "metadata.yaml"), write_mcap, "rosbags", "rosbags", empty=_MESSAGE, joints_of_hand=True
    ),
    "isaac_grasp": _one(
        "isaac_grasp.yaml", write_isaac_grasp, **_YAML, of_hand="values of joints and the pose of a palm",
        empty=(Empty("confidence", QUALITY.replace("; 0 stands there for nothing", "")),
               Empty("pregrasp_cspace_position", OPEN)),
    ),
    "moveit_grasp": _one(
        "moveit_grasp.yaml", write_moveit_grasp, **_YAML, of_hand="values of joints and the pose of a palm",
        empty=(Empty("grasp_quality", QUALITY), Empty("pre_grasp_posture", OPEN),
               Empty("pre_grasp_approach, post_grasp_retreat, post_place_retreat", APPROACH),
               Empty("allowed_touch_objects", "the plan knows of nothing but hand and object")),
    ),
    "mjcf": _one("keyframes.xml", write_mjcf, of_hand="links and joints",
                 empty=(Empty("inertial of links", MASSES), Empty("actuator, equality", "the keyframes need none"))),
}  # fmt: skip
"""In the order in which the command line lists them. A new one is a line here."""


@dataclass(frozen=True)
class Exported:
    """What was written in one format."""

    to: str
    files: tuple[Path, ...]
    empty: tuple[Empty, ...]


@naming_arguments
def export(plan: str | Path | Plan, folder: str | Path, *, to: str | Sequence[str]) -> tuple[Path, ...]:
    """Write a plan in formats of other programs, all or none; docs/export.md says what is in them.

    What a plan knows nothing of stays empty, and is told to the logger "synergrip" at INFO.

    Args:
        plan: a `Plan`, or the folder or the plan.json of a saved one.
        folder: made when it is not there. Files of an earlier export to the same formats are replaced, others stay.
        to: some of "csv", "npz", "parquet", "ros2-yaml", "mcap", "isaac_grasp", "moveit_grasp" and "mjcf"; a single
            text is one of them.

    Returns:
        The files written.

    Raises:
        InputError: no plan, a format that is none of these, one that this plan does not have or whose package is not
            installed, or a path that can be no folder's.
        OutputError: it cannot be written; the folder is as it was.

    Example:
        >>> export(answer, "out/ball/export", to="csv")  # doctest: +SKIP
        (PosixPath('out/ball/export/trajectory.csv'),)
    """
    place, chosen = path_of(folder, "folder"), formats_of(to)
    read = exported_plan(plan)
    found = written_at("folder", place, lambda: write_exports(read, place, chosen))
    for each in found:
        for empty in each.empty:
            LOG.info("%s leaves empty: %s (%s)", each.to, empty.field, empty.why)
    return tuple(file for each in found for file in each.files)


def formats_of(to: object) -> tuple[str, ...]:
    """Return formats by name, each once and judged.

    Raises:
        InputError: one that there is not, or whose package is not installed.
    """
    words = (to,) if isinstance(to, str) else to
    if not isinstance(words, Sequence) or not words:
        raise InputError.at("to", f"expected some of {', '.join(EXPORTERS)}, got {to!r}")
    for word in words:
        if not isinstance(word, str) or word not in EXPORTERS:
            raise InputError.at("to", one_of(word, EXPORTERS))
    chosen = tuple(dict.fromkeys(words))
    missing = {each: EXPORTERS[each].package for each in chosen if EXPORTERS[each].module and not _there(each)}
    raise_issues([
        Issue(f"'{each}' needs {package}, which is not installed: pip install 'synergrip[export]' (or {package} alone)",
              key="to") for each, package in missing.items()
    ])  # fmt: skip
    return chosen


def refuse_unexportable(plan: ExportedPlan, chosen: Sequence[str]) -> None:
    """Raise an InputError that names each format that a plan does not have, and why."""
    without = [] if plan.hand is not None else [each for each in chosen if EXPORTERS[each].of_hand]
    raise_issues([
        Issue(f"'{each}' holds {EXPORTERS[each].of_hand}, and {NO_HAND}; csv, npz, parquet, ros2-yaml and mcap do not "
              "need one", key="to") for each in without
    ])  # fmt: skip


def refuse_export_place(folder: Path, chosen: Sequence[str]) -> None:
    """Raise the OSError that says why nothing can be written into `folder`, as far as it can be told beforehand."""
    refuse_unwritable_folder(folder)
    refuse_others(folder, _names(chosen))


def write_exports(plan: ExportedPlan, folder: Path, chosen: Sequence[str]) -> list[Exported]:
    """Write a plan into a folder, in formats that `formats_of` has judged.

    Raises:
        InputError: formats that this plan does not have.
        OSError: it cannot be done; the folder is as it was.
    """
    refuse_unexportable(plan, chosen)

    def write(new: Path) -> None:
        for each in chosen:
            try:
                EXPORTERS[each].write(plan, new)
            except InputError as error:
                raise error.under(f"{KEY} '{plan.source}'" if plan.source else "plan") from None

    replace_together(folder, _names(chosen), write)
    return [_exported(plan, folder, each) for each in chosen]


def _exported(plan: ExportedPlan, folder: Path, to: str) -> Exported:
    exporter, empty = EXPORTERS[to], list(EXPORTERS[to].empty)
    if exporter.joints_of_hand and plan.hand is None:
        empty.append(Empty("joints", f"{NO_HAND}: how its joints move is known, and not where they are"))
    files = [folder / name for name in exporter.files]
    left_out = {"joints.yaml", "joint_references.yaml"} if plan.hand is None else set()
    return Exported(to, tuple(file for file in files if file.name not in left_out), tuple(empty))


def _names(chosen: Sequence[str]) -> list[str]:
    return [name for each in chosen for name in EXPORTERS[each].files]


def _there(to: str) -> bool:
    return find_spec(EXPORTERS[to].module) is not None
