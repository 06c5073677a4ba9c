"""A plan as it is exported: what plan.json alone says, on a hand at the equilibria that it really comes to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.documents.documents import read_document
from synergrip.errors import InputError, kind_of, shortened
from synergrip.grasps.compliance import joint_compliance
from synergrip.linalg import Array, frozen
from synergrip.planning.arrays import one_line
from synergrip.planning.digest import stated_digest, unchanged
from synergrip.planning.outcome import Plan
from synergrip.planning.references import plan_file
from synergrip.simulation.told_values import Told
from synergrip.values import Value
from synergrip.vectors import rotation_matrices

KEY = "PLAN"
NO_HAND = "the plan is of a grasp given as matrices, which has no hand"
UNITS = ("rad", "m")


@dataclass(frozen=True, eq=False, repr=False)
class HandStates(Value):
    """Where the hand and its object are at the knots, frame of the palm."""

    told: Told
    """The table `execution`."""
    folder: Path
    """In which plan.json stands."""
    q: Array  # (T, n_q)
    commanded: Array  # (T, n_q) where the joints would stand if they carried nothing
    position: Array  # (T, 3) [m] of the object
    rotation: Array  # (T, 3, 3)


@dataclass(frozen=True, eq=False, repr=False)
class ExportedPlan(Value):
    """A plan as it is exported. SI units, T knots."""

    title: str
    source: str
    """The file; empty for a plan in code."""
    version: str
    sha256: str
    """The digest of plan.json; empty when it has none."""
    figures: str
    """What its figures are those of."""
    true: bool
    """Whether that is the equilibria that a hand really comes to."""
    joints: tuple[str, ...]
    synergies: tuple[str, ...]
    contacts: tuple[str, ...]
    joint_units: tuple[str, ...]
    synergy_units: tuple[str, ...]
    """Empty where nobody knows how a synergy is measured."""
    components: tuple[tuple[str, ...], ...]
    """Of each contact, as its rows in `forces`."""
    times: Array  # (T,) [s]
    dz_r: Array  # (T, n_z)
    forces: Array  # (T, n_l)
    torques: Array  # (T, n_q)
    dq: Array  # (T, n_q)
    du: Array  # (T, 6)
    margins: Array  # (T, n_c)
    wrench: Array  # (T, 6)
    hand: HandStates | None
    notes: tuple[str, ...] = ()

    @property
    def about(self) -> dict[str, str]:
        """What a file says of where it comes from."""
        known = {"title": self.title, "figures": self.figures, "synergrip": self.version, "plan_sha256": self.sha256}
        return {key: value for key, value in known.items() if value}


def exported_plan(plan: str | Path | Plan) -> ExportedPlan:
    """Return a plan from its folder, its plan.json, or as it is in code.

    Raises:
        InputError: no such file, no plan in it, or values that are none.
    """
    if isinstance(plan, Plan):
        from synergrip.reports.data.json_plan import outcome_document  # it takes long, and a saved plan has it already

        return _read(outcome_document(plan.grasp.title, plan.grasp, plan), "", Path())
    if not isinstance(plan, str | Path) or "\0" in str(plan):
        message = f"expected the folder or plan.json of a saved plan, or a Plan, got {kind_of(plan)}"
        raise InputError.at("plan", message)
    file = plan_file(Path(plan))
    data = read_document(file, "plan", KEY, numbers=True).data
    try:
        return _read(data, str(file), file.parent)
    except InputError as error:
        raise error.under(f"{KEY} '{file}'") from None


def folder_of(plan: Path) -> Path:
    """Return where the exports of a saved plan go when nothing else is said."""
    return (plan if plan.is_dir() else plan.parent) / "export"


def _read(data: Mapping[str, Any], source: str, folder: Path) -> ExportedPlan:
    if "dz_r" not in data or "time_s" not in data:
        verdict = data.get("verdict")
        said = f"its verdict is '{shortened(verdict)}'" if isinstance(verdict, str) else "dz_r and time_s are missing"
        raise InputError.at("", f"holds no plan: {one_line(said)}; make one with `synergrip plan PROBLEM`")
    told = Told(data, "")
    if told.get("units") is None or told.get("components") is None:
        raise InputError.at("units", "is missing: the file is of an earlier version; plan again")
    joints, synergies, contacts = (_names(told, key) for key in ("joints", "synergies", "contacts"))
    units, components = told.inside("units"), _components(told, len(contacts))
    times = told.array("time_s", (None,))
    if not np.all(np.diff(times) > 0):
        raise InputError.at("time_s", "times must increase")
    n_t, n_q, n_l = len(times), len(joints), sum(map(len, components))
    is_true = told.get("true") is not None
    shown = told.inside("true") if is_true else told
    provenance = told.get("provenance")
    version = provenance.get("version") if isinstance(provenance, dict) else None
    torques, dz_r = told.array("tau", (n_t, n_q)), told.array("dz_r", (n_t, len(synergies)))
    dq, du = told.array("dq", (n_t, n_q)), shown.array("du", (n_t, 6))
    hand = None
    if told.get("execution") is not None:
        execution = told.inside("execution")
        if execution.texts("joints") != told.get("joints"):
            raise execution.refused("joints", "are not those of the plan; was the file changed by hand? plan again")
        q = shown.array("q", (n_t, n_q)) if is_true else execution.array("q_0", (n_q,)) + dq
        hand = _states(execution, folder, q, du, dz_r)
    return ExportedPlan(
        one_line(str(told.get("title") or "plan")), source, one_line(str(version or "")), _digest(data),
        _figures(told, shown), is_true, joints, synergies, contacts,
        _units(units, "joints", n_q), _units(units, "synergies", len(synergies)), components, times, dz_r,
        shown.array("lambda", (n_t, n_l)), torques, dq, du,
        shown.inside("margin").array("per_contact_N", (n_t, len(contacts))), told.array("wrench", (n_t, 6)), hand,
        tuple(_notes(data, hand is not None and not is_true)),
    )  # fmt: skip


def _notes(data: Mapping[str, Any], unexecuted: bool) -> Iterator[str]:
    """Yield what is odd about a plan."""
    if unchanged(data) is False:
        yield "its numbers are not those that were written (digest)"
    if unexecuted:
        yield "it was not executed on the hand that moves; the notes of the plan say why"


def _figures(told: Told, source: Told) -> str:
    """Return what the figures of a plan are those of, in words."""
    if told.get("true") is not None:
        rolling = source.get("contact_model") == "rolling"
        return f"true equilibria of the hand that moves, contacts {'roll' if rolling else 'stay where they are'}"
    of_hand = told.get("execution") is not None
    return f"linear model {'at the start posture, not executed on the hand' if of_hand else 'of the given matrices'}"


def _digest(data: Mapping[str, Any]) -> str:
    found = stated_digest(data) or ""
    return found if found.isalnum() else ""


def _states(told: Told, folder: Path, q: Array, du: Array, dz_r: Array) -> HandStates:
    """Return the states at the knots.

    A joint stands at q = q_0 + S dz_r - C (tau - tau_0); without torque it would be at q_0 + S dz_r + C tau_0, which is
    what a position controller of that compliance is to be told.
    """
    n_q, n_z = q.shape[1], dz_r.shape[1]
    S, C_z = told.array("S", (n_q, n_z)), told.array("C_z", (n_z, n_z))
    C = joint_compliance(told.array("C_q", (n_q, n_q)), S, C_z)
    commanded = told.array("q_0", (n_q,)) + dz_r @ S.T + C @ told.array("tau_0", (n_q,))
    position = told.inside("object").array("position_m", (3,)) + du[:, :3]
    return HandStates(told, folder, q, frozen(commanded), frozen(position), frozen(rotation_matrices(du[:, 3:])))


def printable(names: Sequence[str], key: str) -> tuple[str, ...]:
    """Return names as they can stand in any file: without control characters.

    Raises:
        InputError: two of them are then the same, or one is empty.
    """
    shown = tuple(map(one_line, names))
    if len(set(shown)) != len(shown) or not all(shown):
        raise InputError.at(key, "names must differ, and none may be empty; was the file changed by hand? plan again")
    return shown


def _names(told: Told, key: str) -> tuple[str, ...]:
    return printable(told.texts(key), key)


def _components(told: Told, contacts: int) -> tuple[tuple[str, ...], ...]:
    found = told.get("components")
    texts = isinstance(found, list) and all(isinstance(each, list) and each for each in found)
    if not texts or len(found) != contacts or not all(isinstance(word, str) for each in found for word in each):
        raise told.refused("components", "expected the force components of each contact; plan again")
    return tuple(printable(each, "components") for each in found)


def _units(told: Told, key: str, count: int) -> tuple[str, ...]:
    found = told.get(key)
    if not isinstance(found, list) or len(found) != count or not all(each in (*UNITS, None) for each in found):
        raise told.refused(key, f"expected {' or '.join(UNITS)} for each of {count}; plan again")
    return tuple(each or "" for each in found)
