"""A plan on disk: plan.json, plan.npz and plan.csv, which change together or not at all."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.files import refuse_unwritable_folder
from synergrip.plans.outcome import Outcome, Plan
from synergrip.together import refuse_others, replace_together

FORMATS = ("json", "npz", "csv")
NAMES = tuple(f"plan.{suffix}" for suffix in FORMATS)


def write_outcome(folder: Path, document: dict[str, Any], outcome: Outcome, formats: tuple[str, ...]) -> list[str]:
    """Write an outcome into `folder` and return the names of the files written.

    An outcome without a plan has only a document. Files of an earlier run that are not written anew are removed,
    so that the folder never holds the answer to another question, nor files of two answers.

    Raises:
        OSError: it cannot be done; the folder is as it was.
    """
    writers: dict[str, Callable[[Path], object]] = {
        "json": lambda path: path.write_text(to_json(document) + "\n", encoding="utf-8")
    }
    if isinstance(outcome, Plan):
        writers["csv"] = lambda path: path.write_text(plan_csv(outcome), encoding="utf-8")
        writers["npz"] = lambda path: _write_npz(path, outcome)
    chosen = [suffix for suffix in writers if suffix in formats]

    def write(new: Path) -> None:
        for suffix in chosen:
            writers[suffix](new / f"plan.{suffix}")

    replace_together(folder, NAMES, write)
    return [f"plan.{suffix}" for suffix in chosen]


def refuse_place(folder: Path) -> None:
    """Raise the OSError that says why no outcome can be written into `folder`, as far as it can be told beforehand."""
    refuse_unwritable_folder(folder)
    refuse_others(folder, NAMES)


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
        np.savez(stream, **arrays)  # type: ignore[arg-type]
