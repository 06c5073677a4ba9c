"""What a document of an answer tells beside its lines over time: tables with the words of a grasping engineer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote
from typing import Any

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.documents.quantities import plain, read_as
from synergrip.reports.pictures.cone_sections import when_worst
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.text.text_usages import WITHIN, side_title, worst_of

Document = Mapping[str, Any]

ORDER = ("limits", "allowed", "margins", "contacts", "synergies", "model", "physics", "check", "notes")
"""Anchors of tables, as they follow each other on the page."""
MOST_CASES = 6
"""Cases of what is allowed for that are told."""


@dataclass(frozen=True)
class Cell:
    """One cell of a table."""

    text: str
    number: bool = False
    color: str = ""
    code: bool = False
    """Whether it is to be typed as it stands."""


@dataclass(frozen=True)
class Table:
    """A table under a title, with sentences before and after it, charts (SVG) below, and smaller tables of its own."""

    anchor: str
    title: str
    head: tuple[str, ...] = ()
    rows: tuple[tuple[Cell, ...], ...] = ()
    before: tuple[str, ...] = field(default=())
    after: tuple[str, ...] = field(default=())
    drawn: tuple[str, ...] = field(default=())
    parts: tuple[Table, ...] = field(default=())


def tables_of(document: Document) -> tuple[Table, ...]:
    """Return limits, contacts, promise against truth, and the independent check."""
    parts = (_limits, _allowed, _contacts, _truth, _checks, _notes)
    return tuple(table for part in parts for table in part(document))


def in_folder(command: str, folder: Path | None) -> str:
    """Return a sentence with a command, in which FOLDER is the folder of plan.json, or is said to be it."""
    if folder is None:
        return f"{command} (FOLDER is that of plan.json)"
    return command.replace("FOLDER", quote(str(folder)))


def in_order(tables: Iterable[Table]) -> tuple[Table, ...]:
    """Return tables as they follow each other on the page."""
    return tuple(sorted(tables, key=lambda table: ORDER.index(table.anchor)))


def _limits(document: Document) -> Iterator[Table]:
    """Yield the worst value of every limit at the knots, on each side that is bounded by itself, and between them."""
    limits, mark = document.get("limits") or (), WITHIN * (document["verdict"] == "feasible")
    between = {each["name"]: each for each in (document.get("between") or {}).get("limits", ())}
    rows = []
    for each in limits:
        other, usage = between.get(each["name"]), usage_told(each, document)
        for title, shown, item, time, bound in worst_of(usage, mark=mark):
            # between the knots the worst of both sides is known: it stands beside the side that it is on
            there = other is not None and title in (each["name"], side_title(usage, _side(other)))
            rows.append((
                Cell(title), _number(shown), Cell(item), _number(f"{time:.3g} s"), Cell(bound),
                _number(read_as(other["value"], each["unit"]) if other and there else "–"),
            ))  # fmt: skip
    if rows:
        head = ("limit", "worst", "where", "when", "bound", "between the knots")
        yield Table("limits", "Limits", head, tuple(rows))


def _allowed(document: Document) -> Iterator[Table]:
    """Yield in which cases of what the task allows for the slip margin is smallest."""
    told = document.get("allowances")
    if not told:
        return
    every, drawn = sorted(told["cases"], key=lambda each: float(each["worst_N"])), told.get("scenarios")
    rows = tuple((Cell(each["case"]), _number(f"{plain(each['worst_N'])} N")) for each in every[:MOST_CASES])
    after = [f"of {len(every)} cases; smallest at {told['contact']}, t = {told['time_s']:.3g} s"]
    if drawn and "missing" in drawn:
        after.append(f"{drawn['missing']} of {drawn['count']} fresh scenarios (seed {drawn['seed']}) miss a limit")
    elif drawn:
        after.append(f"of {drawn['count']} scenarios (seed {drawn['seed']}) all hold")
    yield Table("allowed", "What is allowed for", ("case", "smallest slip margin"), rows, after=tuple(after))


def _side(told: Mapping[str, Any]) -> int:
    """Return which bound the worst value of a limit is nearer to: the upper one, 1, or the lower one, -1."""
    lower, value, upper = told["lower"], told["value"], told["upper"]
    return -1 if upper is None or (lower is not None and value - lower < upper - value) else 1


def usage_told(told: Mapping[str, Any], document: Document) -> Usage:
    """Return what is told of a limit; sizes are 1 in documents that were written before they told them."""
    series, true = told["series"], document.get("true") or {}
    ends = ((series["lower"], -np.inf), (series["upper"], np.inf))
    lower, upper = (np.array([none if end is None else end for end in each], dtype=float) for each, none in ends)
    values = np.array(series["values"], dtype=float)
    times = np.array(true.get("time_s", document["time_s"]))
    scale = series.get("scale") or np.ones(len(lower))
    allowance = series.get("allowance")
    return Usage(told["name"], told["unit"], tuple(series["items"]), values, lower, upper, scale, times, allowance)


def _contacts(document: Document) -> Iterator[Table]:
    """Yield where the contacts are, what they are, and the worst that happens to them."""
    told = (document.get("execution") or {}).get("contacts")
    margins = _margins(document)
    if told is None:
        return
    names, colors = [each["name"] for each in told], contact_colors(document["contacts"])
    true = document.get("true")
    forces = None if true is None else np.linalg.norm(np.array(true["force_N"]), axis=2)
    times, rows = document["time_s"], []
    for i, each in enumerate(told):
        k = 0 if margins is None else when_worst(margins[:, i])
        friction = each["parameters"].get("friction")
        least = () if margins is None else (_number(f"{margins[k, i]:.4g} N"), _number(f"{times[k]:.3g} s"))
        force = () if forces is None else (_number(f"{forces[:, i].min():.3g} to {forces[:, i].max():.3g} N"),)
        rows.append((
            Cell(names[i], color=colors[names[i]]), Cell(each["link"]), Cell(each["kind"]),
            _number("–" if friction is None else f"{friction:.3g}"), _number(read_as(each["pad_radius_m"], "m")),
            _number(", ".join(f"{round(1e3 * x, 1) + 0.0:.1f}" for x in each["point_m"])), *least, *force,
        ))  # fmt: skip
    known = ("least margin", "when") * (margins is not None) + ("force",) * (forces is not None)
    head = ("contact", "link", "kind", "friction", "pad radius", "at the start, palm frame [mm]", *known)
    yield Table("contacts", "Contacts", head, tuple(rows))


def _truth(document: Document) -> Iterator[Table]:
    """Yield in which model the figures hold, and what it costs to be wrong about it."""
    true = document.get("true")
    if not true:
        text = "The figures are those of the linear model at the start posture: the grasp has no kinematics."
        if "margin" in document:
            yield Table("model", "Model", before=(text,))
        return
    lines = [f"The figures are those of the equilibria of the hand that moves; contacts: {true['contact_model']}."]
    if true.get("passes"):
        lines.append(f"The grasp was linearised anew {true['passes']} times at all knots.")
    if true.get("worst_N_if_fixed") is not None:
        least = f"{true['worst_N_if_fixed']:.4g} N"
        lines.append(f"If pads stayed where they are instead of rolling, the least margin would be {least}.")
    stiffness = [each for each in true.get("smallest_stiffness_N_m", ()) if each is not None]
    if stiffness:
        lines.append(f"The object is held with {min(stiffness) / 1e3:.3g} N/mm at least.")
    yield Table("model", "Promise and truth", before=tuple(lines))


def _checks(document: Document) -> Iterator[Table]:
    """Yield what was recomputed from the grasp's matrices, whatever the solver said."""
    checks = document.get("checks") or ()
    rows = tuple(
        (Cell(each["name"]), _number("–" if each["error"] is None else f"{each['error']:.1e}"),
         _number(f"{each['tolerance']:.0e}"), Cell("passed" if each["passed"] else "FAILED"))
        for each in checks
    )  # fmt: skip
    proof = document.get("certificate") or {}
    after = f"certificate: {proof.get('kind')}, {'verified' if proof.get('verified') else 'not verified'}" + (
        f", by {proof['solver']}" if proof.get("solver") else "")  # fmt: skip
    if proof.get("kind") == "none":
        after = "There is no certificate: neither that there is a plan nor that there is none is proven."
    yield Table("check", "Independent check", ("what", "error", "allowed", ""), rows, after=(after,))


def _notes(document: Document) -> Iterator[Table]:
    if document.get("notes"):
        yield Table("notes", "Notes", before=tuple(str(note) for note in document["notes"]))


def _margins(document: Document) -> Any:
    told = (document.get("true") or {}).get("margin") or document.get("margin") or {}
    return np.array(told["per_contact_N"]) if "per_contact_N" in told else None


def _number(text: str) -> Cell:
    return Cell(text, number=True)
