"""How each synergy moves a hand: skeletons at the posture, one step on and one step back; and their panel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.grasps.shapes.shape import circle
from synergrip.hands.hand import Hand, Pad, SynergySet
from synergrip.linalg import Array
from synergrip.reports.pictures.depth import Depth
from synergrip.reports.pictures.sheet import GREY, INK, Panel
from synergrip.reports.pictures.skeleton import Skeleton, skeleton
from synergrip.reports.pictures.solids import around
from synergrip.reports.pictures.steps import Step, steps
from synergrip.reports.pictures.view import View, best_view

MOVED, BACK = "#7b3fa0", "#c9abdc"
"""Colours of a hand that a synergy moves on, and back: violet and light violet, which are those of no contact."""
STILL = 1e-5
"""A bone that moves less is drawn where it was [m]."""


@dataclass(frozen=True)
class Motion:
    """A hand moved by one synergy."""

    name: str
    step: Step
    on: Skeleton
    """At ``q + S_k step``."""
    back: Skeleton
    """At ``q - S_k step``."""

    @property
    def title(self) -> str:
        """Name and step."""
        return f"{self.name}  {self.step.text}" if self.step.text else f"{self.name}  moves nothing"


@dataclass(frozen=True)
class Motions:
    """A hand and its synergies, one at a time."""

    rest: Skeleton
    each: tuple[Motion, ...]

    @property
    def points(self) -> Array:
        """All points that are drawn (n, 3)."""
        return np.vstack([self.rest.points, *(each.points for m in self.each for each in (m.on, m.back))])

    def view(self) -> View:
        """Return a view in which every synergy is seen to move."""
        return best_view(self.rest.points, [motion.on.points - self.rest.points for motion in self.each])


def motions(hand: Hand, synergies: SynergySet, q: Array, pads: Sequence[Pad], first: int) -> Motions:
    """Return the hand at `q` (n_q,) with some `pads`, moved by each of the `first` synergies alone."""
    each = []
    for name, column, step in zip(synergies.synergies[:first], synergies.S.T, steps(hand, synergies, q), strict=False):
        on, back = (skeleton(hand, q + sign * step.value * column, pads) for sign in (1, -1))
        each.append(Motion(name, step, on, back))
    return Motions(skeleton(hand, q, pads), tuple(each))


def draw_motion(panel: Panel, view: View, rest: Skeleton, motion: Motion) -> None:
    """Draw a hand: what stays in black, what moves in grey at rest, in colour moved and faintly moved back."""
    moved = np.abs(motion.on.bones - rest.bones).max(axis=(1, 2)) > STILL
    depth = Depth.of(view, rest.points)
    if len(rest.palm):
        panel.area(around(view.flat(rest.palm)), GREY, 0.25, near=5.0 + float(view.depth(rest.palm).mean()))
    _bones(panel, depth, rest.bones[~moved], INK, 3.2)
    for bones, color, width in ((motion.back.bones, BACK, 1.6), (rest.bones, GREY, 2.4), (motion.on.bones, MOVED, 3.2)):
        _bones(panel, depth, bones[moved], color, width)
    still = np.abs(motion.on.pads - rest.pads).max(axis=1, initial=0.0) <= STILL
    for place, radius, stays in zip(motion.on.pads, rest.radii, still, strict=True):
        color, middle = INK if stays else MOVED, view.flat(place)
        panel.area(middle + radius * circle(), color, 0.15, near=8.9)
        panel.dots(middle[None], color, 6.0, near=9.0, edge=0.8)


def _bones(panel: Panel, depth: Depth, bones: Array, color: str, width: float) -> None:
    for bone in bones:
        near, (tone, thick) = 5.0 + float(depth.view.depth(bone).mean()), depth.drawn(bone, color, width)
        panel.strokes([depth.view.flat(bone)], tone, thick, near)
        panel.dots(depth.view.flat(bone), tone, 1.7 * thick, near)
