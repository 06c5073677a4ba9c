"""What is known of how sure a grasp is, and of how far it may be pushed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from synergrip.documents.naming import made_by
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.disturbance.disturbances import Disturbances
from synergrip.margin.measures import Measure
from synergrip.margin.sensitivity.sensitivity import Sensitivities
from synergrip.margin.timing.fastest_timing import FastestTiming
from synergrip.margin.wrench_space.quality import WrenchSpaceQuality
from synergrip.planning.outcome import Plan
from synergrip.values import Value


@made_by("margins(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class Margins(Value):
    """Every margin of a plan, and how heavy, slippery, hard, fast and far it may get.

    Example:
        >>> found = margins(problem.grasp, problem.task)  # doctest: +SKIP
        >>> found.direct["heaviest_kg"].value, found.measures["slip margin"].worst.value  # doctest: +SKIP
        (0.33081, 0.5)
    """

    plan: Plan
    measures: Mapping[str, Measure]
    """By name: of the hand that moves where there is one, of the linear model else."""
    linear: Mapping[str, Measure] | None
    """The same references in the linear model of the start posture, on a hand."""
    direct: Mapping[str, DirectNumber] = field(default_factory=dict)
    """By name; those that were found before somebody interrupted."""
    disturbance: Disturbances | None = None
    """What it withstands beside its load; None where it was not asked for."""
    quality: WrenchSpaceQuality | None = None
    """The classical figures of the grasp; None where they were not asked for, or nothing is known of its contacts."""
    sensitivities: Sensitivities | None = None
    """How much the largest margin, and the worst one under these references, change with each number."""
    on_request: Mapping[str, Mapping[str, DirectNumber]] = field(default_factory=dict)
    """By name, then by contact or rigid motion: `critical_friction_per_contact`, `largest_amplitude_per_mode`."""
    timing: FastestTiming | None = None
    """The fastest timing along the path of the palm, when it was asked for."""
    interrupted: bool = False
