"""What the pictures say in words: what is drawn how, and what the forces depend on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Protocol

import numpy as np

from synergrip.grasps.contacts.kind import is_moment
from synergrip.grasps.held import Held
from synergrip.linalg import Array
from synergrip.problems.in_short import many
from synergrip.reports.pictures.layout import MOST
from synergrip.statics.analysis import Analysis
from synergrip.tasks.timed_task import TimedTask

PER_TORQUE = "rad/(N\u00a0m)"
"""Kept on one line."""
MOTION_NOTE = "Grey: the posture. Violet: one synergy moved by its step. Light violet: moved back as far."


class Asked(Protocol):
    """What a picture of a grasp tells of what was asked, as a problem does."""

    @property
    def title(self) -> str:
        """For people."""

    @property
    def held(self) -> Held | None:
        """Hand and object; None for a grasp given as matrices."""

    @property
    def timed(self) -> TimedTask:
        """The task at its knots."""


def left_out(count: int) -> str:
    """Return what is to be said when not all of `count` synergies are drawn; empty when they are."""
    return f" The first {MOST} of {count} synergies are drawn." if count > MOST else ""


def subtitle(analysis: Analysis) -> str:
    """Return the dimensions of the subspaces, and the contacts."""
    forces, motions, redundant = analysis.spaces.dimensions
    kinds = Counter(contact.kind.title for contact in analysis.grasp.contacts)
    contacts = " and ".join(many(count, f"{kind} contact") for kind, count in kinds.items())
    dimensions = f"dim E_s {forces}, dim Γ_ucs {motions}, dim Γ_zr {redundant}"
    return f"{many(analysis.grasp.n_z, 'synergy')} · {dimensions} · {contacts}"


def grasp_notes(asked: Asked, analysis: Analysis, spins: bool) -> Iterator[str]:
    """Yield the footnotes of a picture of forces, in which there are spin moments or not."""
    if asked.held:
        yield MOTION_NOTE
    yield f"Dashed at the contacts: their normals.{left_out(analysis.grasp.n_z)}"
    yield (
        "Arrows in the colours of the contacts: internal forces of the hand on the object that one synergy alone "
        f"generates, equation (28) with dw = 0{'; arcs: their spin moments' if spins else ''}. Each panel has its own "
        "scale of forces; the largest stands above it. What squeezes is the part of J S_k that no rigid motion of the "
        "object follows."
    )
    yield f"The forces depend on the compliances, here {', '.join(_compliances(asked, analysis))}."


def _compliances(asked: Asked, analysis: Analysis) -> Iterator[str]:
    """Yield the diagonals of C_s, C_q and C_z with their units."""
    grasp = analysis.grasp
    spin = np.array([is_moment(component) for _, component in grasp.components])
    contact = np.diag(grasp.C_s)
    yield f"contacts {_range(1e3 * contact[~spin])} mm/N"
    if np.any(spin):
        yield f"spin {_range(contact[spin])} {PER_TORQUE}"
    yielding = np.diag(grasp.C_q)
    if asked.held is None:
        yield f"joints {_range(yielding)} and synergies {_range(np.diag(grasp.C_z))} (SI units)"
        return
    slides = np.array([joint.kind == "slide" for joint in asked.held.hand.joints])
    if not np.all(slides):
        yield f"joints {_range(yielding[~slides])} {PER_TORQUE}"
    if np.any(slides):
        yield f"sliding joints {_range(1e3 * yielding[slides])} mm/N"
    yield f"synergies {_range(np.diag(grasp.C_z))}"


def _range(values: Array) -> str:
    low, high = float(values.min()), float(values.max())
    return f"{low:.3g}" if f"{low:.3g}" == f"{high:.3g}" else f"{low:.3g} to {high:.3g}"
