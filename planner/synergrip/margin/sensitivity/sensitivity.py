"""How much a margin changes with one number of the grasp or the task."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from synergrip.documents.judging import described, is_whole
from synergrip.documents.naming import made_by
from synergrip.errors import InputError, one_of
from synergrip.values import Value

LARGEST, FIXED = "largest margin (dual)", "fixed references (direct)"
"""The two margins that there are derivatives of."""
KINDS = (LARGEST, FIXED)
START, HAND = "the linear model of the start posture", "the hand that moves"
"""What they are derivatives in."""
NOTHING = 1e-7
"""Share of a margin that a change adds, or [N], that is nothing."""


@made_by("sensitivities(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class Sensitivity(Value):
    """The derivative of a margin by one number.

    Where a margin has a kink, as where two contacts are the worst and a number helps the one only, there are two
    derivatives: `right` for a larger number, `left` for a smaller one; `value` is then None.

    Example:
        >>> most = sensitivities(grasp, task).worth_most("largest margin (dual)")[0]  # doctest: +SKIP
        >>> most.name, most.of, most.value, most.unit, most.per  # doctest: +SKIP
        ('friction', 'all contacts', 0.012, 'N', '1 %')
    """

    kind: str
    """"largest margin (dual)", of the best references for each value; or "fixed references (direct)", of the worst
    margin under the references of the plan."""
    model: str
    """What it is a derivative in: the linear model of the start posture, or the hand that moves."""
    name: str
    """What is changed: "friction", "mass", "stiffness", "position" and so on."""
    of: str
    """Whose it is: a contact, a joint, a synergy, or all of them."""
    direction: str
    """Where to, for a place or a normal: along or about an axis of the contact; empty for a number."""
    at: float | None
    """What the number is [SI]; None where it is several, or a place."""
    per: str
    """The change that `value` is told for: "1 %", "1 mm" or "1 deg"."""
    step: float
    """The same in the unit of the number: 0.01 of itself, 0.001 m, pi/180 rad."""
    left: float | None
    """[N] change of the margin for `per` more, as it is toward smaller numbers; None where it is not known."""
    right: float | None
    """[N] the same toward larger numbers."""
    differentiable: bool
    """Whether both are the same."""
    why: str = ""
    """Why there is no one derivative."""
    unit: str = "N"

    @property
    def value(self) -> float | None:
        """[N] how much the margin grows for `per` more; None where that is not one number."""
        return self.right if self.differentiable else None

    @property
    def derivative(self) -> float | None:
        """The same by the number itself: [N] for the whole of it (a factor), [N/m] or [N/rad]; None as `value`."""
        return None if self.value is None else self.value / self.step

    @property
    def gain(self) -> float:
        """[N] what a change by `per` adds to the margin where it is made the better way; 0 where neither way adds."""
        if self.left is None or self.right is None:
            return 0.0
        return float(max(self.right, -self.left, 0.0))

    @property
    def grows(self) -> bool:
        """Whether the better way is toward a larger number."""
        return self.right is not None and self.gain == self.right

    @property
    def size(self) -> float:
        """[N] the larger of both derivatives; 0 where nothing is known."""
        return float(np.abs([part for part in (self.left, self.right) if part is not None]).max(initial=0.0))


@made_by("sensitivities(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class Sensitivities(Value):
    """How much two margins of a task change with each number of the grasp and the task.

    Example:
        >>> found = sensitivities(grasp, task)  # doctest: +SKIP
        >>> [(each.name, each.of) for each in found.worth_most("largest margin (dual)")]  # doctest: +SKIP
        [('friction', 'all contacts'), ('force cap', 'the task'), ('mass', 'the object')]
    """

    margins: Mapping[str, float | None]
    """[N] by kind: what is differentiated; None where there is none."""
    each: tuple[Sensitivity, ...]
    """All of them, in the order of their numbers, one kind after the other."""
    left_out: Mapping[str, str]
    """What there is no derivative of, or by, and why."""
    interrupted: bool = False
    """Whether somebody stopped it before all were found."""

    def of(self, kind: str) -> tuple[Sensitivity, ...]:
        """Return those of one kind.

        Raises:
            InputError: there is no such kind.
        """
        if kind not in KINDS:
            raise InputError.at("kind", one_of(kind, KINDS))
        return tuple(each for each in self.each if each.kind == kind)

    def worth_most(self, kind: str, count: int = 3) -> tuple[Sensitivity, ...]:
        """Return the changes that add most to a margin: by 1 % of a number, 1 mm of a place or 1 deg of a normal each.

        Args:
            kind: "largest margin (dual)" or "fixed references (direct)".
            count: how many at most; those that add nothing are left out.

        Raises:
            InputError: there is no such kind, or no such number of them.
        """
        if not is_whole(count) or count < 1:
            raise InputError.at("count", f"expected how many, 1 or more; got {described(count)}")
        found = sorted(self.of(kind), key=lambda each: -float(f"{each.gain:.6g}"))[:count]  # alike ones in their order
        return tuple(each for each in found if each.gain > NOTHING * max(1.0, abs(self.margins[kind] or 0.0)))
