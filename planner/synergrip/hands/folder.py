"""From a folder with hand.toml, or from a model file alone, to a `Hand`."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from os.path import isdir, isfile  # unlike those of Path, no error for a name that is too long
from pathlib import Path

import numpy as np

from synergrip.documents.documents import Document, parse, read_document
from synergrip.documents.naming import naming_arguments
from synergrip.documents.quantities import quantity
from synergrip.errors import InputError, Issue, one_of, raise_issues, repeated, suggest
from synergrip.files import bundled
from synergrip.hands.bare import bare_hand
from synergrip.hands.follower_ranges import FollowerRanges, led
from synergrip.hands.hand import Coupling, Hand, Joint, Pad, SynergySet
from synergrip.hands.hand_drives import told_drives
from synergrip.hands.hand_file import FILE, HandFile, JointTable, PadTable, PostureTable
from synergrip.hands.kinematics import kinematics
from synergrip.hands.models.foreign_files import XACRO
from synergrip.hands.models.model_file import SUFFIXES, read_model
from synergrip.hands.models.tree import LinkTree
from synergrip.hands.synergies.matrix import coupling_map, joint_posture, joint_values, outside_limits, override
from synergrip.hands.synergies.sets import each_of, synergy_sets
from synergrip.hands.units import joint_kinds, misfits, synergy_kinds
from synergrip.linalg import Array, frozen

FOLDERS = ("urdf", "mjcf", "xml")
"""Where the packages of robots keep their model files."""


def bundled_hands() -> tuple[str, ...]:
    """Return the names of the hands that come with synergrip."""
    folder = bundled("models") / "hands"
    return tuple(sorted(entry.parent.name for entry in folder.glob(f"*/{FILE}")))


@naming_arguments
def load_hand(
    name_or_path: str | Path,
    *,
    relative_to: Path | None = None,
    coupling: Mapping[str, float] | float | None = None,
    palm: str = "",
    follower_ranges: FollowerRanges | None = None,
    key: str = "name_or_path",
) -> Hand:
    """Return a hand by the name of a bundled one, or by a path.

    Args:
        name_or_path: a name of `bundled_hands`, or the path of a folder that holds hand.toml, of a hand.toml, or of a
            URDF or MJCF file (``.urdf``, ``.xml``, ``.mjcf``) that stands for itself, see `bare_hand`.
        relative_to: the folder a path is relative to; the current one when absent.
        coupling: ratios that replace those of the hand: one for all followers, or by follower.
        follower_ranges: whether ranges that the model file states for followers count ("keep"), or what couplings make
            of those of their drivers ("ignore"); as the hand has it when absent.
        palm: of a URDF or MJCF file, when it is not the outermost link. What it does not carry is left out.
        key: where the name stands, for the error; coupling, follower ranges and palm stand beside it.

    Raises:
        InputError: no such hand, a file that cannot be used (located in it), or a coupling or palm that it has not.

    Example:
        >>> load_hand("barrett").postures.keys()
        dict_keys(['open', 'ball'])
    """
    path = find_hand(name_or_path, relative_to, key)
    beside = key.rpartition(".")[0]
    at = f"{beside}.coupling" if beside else "coupling"
    if path.name != FILE:
        tree = _model(path, key, palm=palm, palm_key=f"{beside}.palm" if beside else "palm")
        try:
            chosen = override(tree.couplings, coupling, at)
            _any_follower(chosen, follower_ranges, beside)
            return replace(bare_hand(path.stem, tree, chosen, follower_ranges or "keep"), file=str(path.resolve()))
        except InputError as error:
            raise error.located(lambda issue: issue if issue.key else replace(issue, key=key)) from None
    document = read_document(path, "hand file")
    file = parse(document, HandFile)
    try:
        tree = _model(path.parent / file.model, "model", file.couplings, file.palm or "")
    except InputError as error:
        raise error.located(document.locate) from None
    if palm and palm != tree.root:
        message = f"'{tree.root}' is the palm of this hand, as its {FILE} has it; name another one there, in 'palm'"
        raise InputError.at(f"{beside}.palm" if beside else "palm", message)
    chosen = override({**tree.couplings, **_told(document, file)}, coupling, at)
    _any_follower(chosen, follower_ranges, beside)
    if follower_ranges is not None:
        file = file.model_copy(update={"follower_ranges": follower_ranges})
    try:
        hand = _hand(path.parent, file, tree, chosen, judge_postures=coupling is None)
        return replace(hand, file=str((path.parent / file.model).resolve()))
    except InputError as error:
        raise error.located(document.locate) from None


def _model(path: Path, key: str, told: Collection[str] = (), palm: str = "", palm_key: str = "palm") -> LinkTree:
    """Return what `read_model` does, with the palm at `palm_key` in errors."""
    try:
        return read_model(path, key, told, palm)
    except InputError as error:
        raise error.located(lambda issue: replace(issue, key=palm_key) if issue.key == "palm" else issue) from None


def find_hand(name_or_path: str | Path, relative_to: Path | None, key: str) -> Path:
    """Return the hand.toml of a hand, or its model file; an `InputError` at `key` where there is no such hand."""
    name = str(name_or_path)
    names = bundled_hands()
    if name in names:
        return bundled("models") / "hands" / name / FILE
    path = (relative_to or Path()) / name
    folder = path.parent if path.name == FILE else path
    if name and isfile(folder / FILE):
        return (folder / FILE).resolve()
    if path.name != FILE and (isfile(path) or (path.suffix.lower() in (*SUFFIXES, XACRO) and not isdir(path))):
        return path
    listed = ", ".join(names)
    raise InputError.at(
        key,
        f"{name!r} is neither a bundled hand ({listed}) nor a folder with {FILE} nor a .urdf, .xml or .mjcf file"
        f"{_models_near(path, name) or suggest(name, names)}",
    )


def _models_near(path: Path, name: str) -> str:
    """Return the model files that may be meant by a folder without hand.toml, or by a name without its suffix."""
    if isdir(path):
        entries = [
            each for under in ("", *FOLDERS) for suffix in SUFFIXES for each in (path / under).glob(f"*{suffix}")
        ]
        found = sorted(str(Path(name) / entry.relative_to(path)) for entry in entries if isfile(entry))
    else:
        found = [f"{name}{suffix}" for suffix in SUFFIXES if name and isfile(f"{path}{suffix}")]
    listed = " or ".join(f"'{each}'" for each in found[:3])
    return f"; did you mean the model file {listed}?" if found else ""


def _told(document: Document, file: HandFile) -> dict[str, Coupling]:
    """Return the couplings of a hand.toml, each with its place."""
    places = {name: document.locate(Issue("", key=f"couplings.{name}")) for name in file.couplings}
    return {
        name: Coupling({each.joint: each.ratio}, each.offset, each.rigid, f"{places[name].file}:{places[name].line}")
        for name, each in file.couplings.items()
    }


def _any_follower(couplings: Mapping[str, Coupling], wish: FollowerRanges | None, beside: str) -> None:
    """Refuse a wish about followers when the hand has none."""
    if wish is not None and not couplings:
        key = f"{beside}.follower_ranges" if beside else "follower_ranges"
        raise InputError.at(key, "no joint of this hand follows another one; leave it out", on_key=True)


def _hand(
    folder: Path, file: HandFile, tree: LinkTree, couplings: dict[str, Coupling], *, judge_postures: bool
) -> Hand:
    names = [table.name for table in file.joint]
    _check_names(tree, names)
    rows = {f"joint[{index}]": table for index, table in enumerate(file.joint)}
    joints = tuple(each_of("", rows, lambda _, table: _joint(tree, table)).values())
    if file.follower_ranges == "ignore":
        joints = led(joints, couplings, *coupling_map(names, couplings))
    compliance = each_of("", rows, lambda _, table: _compliance(tree, table)).values()
    kinds = joint_kinds(joints)
    offsets = [(f"couplings.{follower}.offset", follower, each.offset) for follower, each in file.couplings.items()]
    raise_issues(misfits(offsets, kinds))
    sets = synergy_sets(file, folder, kinds, couplings)
    postures = each_of("postures", file.postures, lambda _, table: _posture(table, sets, kinds, couplings))
    if judge_postures:
        each_of("postures", postures, lambda _, q: _within_limits(joints, q, couplings))
    return Hand(
        name=folder.name,
        title=file.title,
        joints=joints,
        C_q=frozen(np.diag(list(compliance))),
        pads=each_of("pads", file.pads, lambda name, table: _pad(tree, name, table)),
        synergy_sets=sets,
        postures=postures,
        kinematics=kinematics(tree, names),
        couplings=couplings,
        parents=tree.parents,
        drives=told_drives(tree, couplings, file),
        still=tree.still,
    )


def _check_names(tree: LinkTree, names: Sequence[str]) -> None:
    issues = []
    twice = set(repeated(names))
    for index, name in enumerate(names):
        if index in twice:
            issues.append(Issue(f"'{name}' is listed twice", key=f"joint[{index}].name"))
        elif name not in tree.moving:
            issues.append(Issue(f"moving joint {one_of(name, tree.moving)}", key=f"joint[{index}].name"))
    missing = [name for name in tree.moving if name not in names]
    if missing and not issues:
        listed = ", ".join(f"'{name}'" for name in missing)
        issues.append(Issue(f"the model also moves {listed}; list every moving joint", key="joint"))
    raise_issues(issues)


def _joint(tree: LinkTree, table: JointTable) -> Joint:
    joint = tree.joints[table.name]
    limit = math.inf
    if table.torque_limit is not None:
        limit = quantity(table.torque_limit, "torque" if joint.kind == "hinge" else "force", "torque_limit")
    if not limit > 0:
        raise InputError.at("torque_limit", f"must be greater than 0, got {table.torque_limit!r}")
    range_ = {"lower": joint.lower, "upper": joint.upper}
    return Joint(name=joint.name, kind=joint.kind, torque_limit=limit, link=joint.child, place=joint.place, **range_)


def _compliance(tree: LinkTree, table: JointTable) -> float:
    if table.compliance is None:
        return 0.0
    kind = "joint compliance" if tree.joints[table.name].kind == "hinge" else "slide compliance"
    value = quantity(table.compliance, kind, "compliance")
    if value < 0:
        raise InputError.at("compliance", f"must be at least 0, got {table.compliance!r}")
    return value


def _pad(tree: LinkTree, name: str, table: PadTable) -> Pad:
    if table.link not in tree.links:
        raise InputError.at("link", one_of(table.link, tree.links))
    return Pad(
        name=name, link=table.link, point=frozen(table.point), normal=frozen(table.normal), radius=table.radius or 0.0
    )


def _posture(
    table: PostureTable, sets: Mapping[str, SynergySet], kinds: Mapping[str, str], couplings: Mapping[str, Coupling]
) -> Array:
    if table.joints is not None:
        for name in table.joints:
            if name not in kinds:
                raise InputError.at(f"joints.{name}", one_of(name, kinds), on_key=True)
        raise_issues(misfits([(f"joints.{name}", name, value) for name, value in table.joints.items()], kinds))
        return frozen(joint_posture(tuple(kinds), table.joints, couplings))
    if table.set is not None and table.set not in sets:
        raise InputError.at("set", one_of(table.set, sets))
    chosen = sets[table.set] if table.set else next(iter(sets.values()))
    values = table.synergies or {}
    for name in values:
        if name not in chosen.synergies:
            raise InputError.at(f"synergies.{name}", one_of(name, chosen.synergies), on_key=True)
    given = [(f"synergies.{name}", name, value) for name, value in values.items()]
    raise_issues(misfits(given, synergy_kinds(chosen, kinds.values()), "synergy"))
    return joint_values(chosen, values)


def _within_limits(joints: Sequence[Joint], q: Array, couplings: Mapping[str, Coupling]) -> None:
    raise_issues(outside_limits(joints, q, "", couplings))
