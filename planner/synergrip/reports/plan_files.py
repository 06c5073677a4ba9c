"""A plan on disk: plan.json, plan.npz and plan.csv, each written whole or not at all."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.files import atomic_path
from synergrip.plans.outcome import Outcome, Plan

FORMATS = ("json", "npz", "csv")


def write_outcome(folder: Path, document: dict[str, Any], outcome: Outcome, formats: tuple[str, ...]) -> list[str]:
    """Write an outcome into `folder` and return the names of the files written.

    An outcome without a plan has only a document. Files of an earlier run that are not written anew are removed,
    so that the folder never holds the answer to another question.
    """
    writers: dict[str, Callable[[Path], object]] = {
        "json": lambda path: path.write_text(to_json(document) + "\n", encoding="utf-8")
    }
    if isinstance(outcome, Plan):
        writers["csv"] = lambda path: path.write_text(plan_csv(outcome), encoding="utf-8")
        writers["npz"] = lambda path: _write_npz(path, outcome)
    written = [f"plan.{suffix}" for suffix in writers if suffix in formats]
    with ExitStack() as all_or_none:  # every file is complete before the first one takes its place
        for name in written:
            writers[name.removeprefix("plan.")](all_or_none.enter_context(atomic_path(folder / name)))
    for name in {f"plan.{suffix}" for suffix in FORMATS} - set(written):
        (folder / name).unlink(missing_ok=True)
    return written


def to_json(document: dict[str, Any]) -> str:
    """Return the document as JSON text; a number that is not finite is a defect and raises ValueError."""
    return json.dumps(document, allow_nan=False)


def plan_csv(plan: Plan) -> str:
    """Return one line per knot: time, references, contact forces, joint torques, object displacement, margins."""
    grasp = plan.analysis.grasp
    axes = ("x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad")
    header = ["t_s", *(f"zr_{i + 1}" for i in range(grasp.n_z))]
    header += [f"lambda_{contact}_{c}" + ("_Nm" if c == "m" else "_N") for contact, c in grasp.components]
    header += [f"tau_{name}" for name in grasp.joints] + [f"du_{axis}" for axis in axes]
    header += [f"margin_{contact.name}_N" for contact in grasp.contacts]
    motion = plan.motion
    table = np.column_stack([motion.times, motion.dz_r, motion.forces, motion.torques, motion.du, plan.margins])
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerow(map(_one_line, header))  # with quotes around names with commas
    np.savetxt(stream, table, fmt="%.17g", delimiter=",")
    return stream.getvalue()


def _one_line(name: str) -> str:
    """Return the name of a column without control characters, which a model file may hold."""
    return "".join(letter if letter.isprintable() else "?" for letter in name)


def _write_npz(path: Path, plan: Plan) -> None:
    motion, grasp = plan.motion, plan.analysis.grasp
    arrays = {
        "time_s": motion.times, "dz_r": motion.dz_r, "alpha": plan.alpha, "beta": plan.beta, "gamma": plan.gamma,
        "lambda": motion.forces, "wrench": motion.wrench, "du": motion.du, "dq": motion.dq, "tau": motion.torques,
        "sigma": motion.efforts, "margin": plan.margins, "elastic_motion": plan.elastic_motion, "sag": motion.sag,
        "joints": np.array(grasp.joints), "synergies": np.array(grasp.synergies),
        "contacts": np.array([contact.name for contact in grasp.contacts]),
    }  # fmt: skip
    with path.open("wb") as stream:
        np.savez(stream, allow_pickle=False, **arrays)
