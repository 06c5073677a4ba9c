"""A simulation as a JSON document, and on disk: model.xml, simulation.json and simulation.csv together."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.files import refuse_unwritable_folder
from synergrip.planning.digest import with_digest
from synergrip.planning.told import finite
from synergrip.simulation.simulation import Simulation
from synergrip.together import refuse_others, replace_together

NAMES = ("simulation.json", "simulation.csv", "model.xml")
MOTION = ("x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad")


def simulation_document(simulation: Simulation) -> dict[str, Any]:
    """Return a simulation as a JSON document, SI units, with its own digest and that of the plan it is of."""
    worst, contact, time = simulation.worst
    shift, turn = simulation.motion_error
    half, true = simulation.half_step, simulation.true
    return with_digest({
        "title": simulation.title, "verdict": simulation.verdict, "exit_code": simulation.exit_code,
        "plan_sha256": simulation.plan_digest,
        "engine": "mujoco", "speed": simulation.speed, "step_s": simulation.step,
        "friction_factor": simulation.friction, "as_written": simulation.as_written,
        "failed_at_s": simulation.failed_at, "ended_at_s": simulation.ended,
        "contacts": list(simulation.contacts), "joints": list(simulation.joints),
        "lost": list(simulation.lost), "slipped": list(simulation.slipped), "at_cone": list(simulation.at_cone),
        "lost_at_s": [finite(each) for each in simulation.lost_at],
        "slipped_at_s": [finite(each) for each in simulation.slipped_at],
        "on_cone_s": simulation.on_cone.tolist(),
        "cone_at_s": [None if np.isnan(each).any() else each.tolist() for each in simulation.cone_at],
        "crept_m": simulation.crept[0].tolist(), "crept_rad": simulation.crept[1].tolist(),
        "margin": {
            "worst_N": worst, "contact": contact, "time_s": time, "least_N": simulation.least.tolist(),
            "least_at_s": simulation.least_at.tolist(), "per_contact_N": simulation.margin.tolist(),
        },
        "promised": {"worst_N": simulation.promised_worst, "least_N": simulation.promised_least.tolist(),
                     "per_contact_N": simulation.promised.tolist(),
                     "du": simulation.promised_du.tolist()},
        "true": None if true is None else {"worst_N": simulation.true_worst, "per_contact_N": true.tolist()},
        "differs": {
            "more_than_N": simulation.within, "likely_cause": simulation.likely_cause,
            "contacts": [{"contact": each.contact, "played_N": each.played, "promised_N": each.promised}
                         for each in simulation.differences],
        },
        "motion_error": {"shift_m": shift, "turn_rad": turn},
        "half_step": None if half is None else {"margin_N": finite(half[0]), "shift_m": finite(half[1])},
        "notes": list(simulation.notes), "time_s": simulation.time.tolist(), "lambda": simulation.forces.tolist(),
        "slip_m": simulation.slip.tolist(), "spin_rad": simulation.spin.tolist(),
        "touching": simulation.touching.tolist(), "apart_s": simulation.apart.tolist(),
        "du": simulation.du.tolist(), "q": simulation.q.tolist(),
    })  # fmt: skip


def simulation_csv(simulation: Simulation) -> str:
    """Return one line per instant: time, margins beside those promised, slips, and the motion beside that promised."""
    names = simulation.contacts
    parts = [
        (("t_s",), simulation.time[:, None]),
        ([f"margin_{name}_N" for name in names], simulation.margin),
        ([f"promised_{name}_N" for name in names], simulation.promised),
        ([f"slip_{name}_m" for name in names], simulation.slip),
        (MOTION, simulation.du),
        ([f"promised_{name}" for name in MOTION], simulation.promised_du),
    ]
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerow([name for header, _ in parts for name in header])
    np.savetxt(stream, np.hstack([values for _, values in parts]), fmt="%.9g", delimiter=",")
    return stream.getvalue()


def write_simulation(folder: Path, simulation: Simulation) -> list[str]:
    """Write a simulation into a folder and return the names of the files written.

    Raises:
        OSError: it cannot be done; the folder is as it was.
    """
    texts = {
        "simulation.json": json.dumps(simulation_document(simulation), allow_nan=False) + "\n",
        "simulation.csv": simulation_csv(simulation),
        "model.xml": simulation.model,
    }

    def write(new: Path) -> None:
        for name, text in texts.items():
            (new / name).write_text(text, encoding="utf-8")

    replace_together(folder, NAMES, write)
    return list(NAMES)


def refuse_simulation_place(folder: Path) -> None:
    """Raise the OSError that says why no simulation can be written into `folder`, as far as it can be told before."""
    refuse_unwritable_folder(folder)
    refuse_others(folder, NAMES)
