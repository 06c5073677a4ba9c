"""The numbers of what a task allows for: with less of it there is more room."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.conic.limits.dial import Cause, Dial
from synergrip.linalg import Array
from synergrip.tasks.allowances import Allowances
from synergrip.tasks.scenarios import Scenarios
from synergrip.tasks.task import Task

LEAST = 1e-6
"""Share of what is allowed for that is as good as none."""
SIZES: tuple[tuple[str, Cause, str], ...] = (
    ("position", "tolerance", "m"), ("normal", "tolerance", "rad"), ("compliance", "stiffness", ""),
)  # fmt: skip
"""Sizes of scenarios, what they are told as, and their units."""
FRICTION_END = 100.0
"""How many times its friction a contact is asked to have at most."""


def allowance_dials(asked: Asked) -> Iterator[Dial[Asked]]:
    """Yield every number of what a task allows for; of values by name of contact none, which are several."""
    task = asked.task
    if isinstance(task, Task) and task.allow is not None:
        yield from _Dials(asked, task.allow).all()


@dataclass(frozen=True)
class _Dials:
    """Makes the dials of what a task allows for."""

    asked: Asked
    allow: Allowances

    def all(self) -> Iterator[Dial[Asked]]:
        """Yield them."""
        allow, held = self.allow, self.asked.grasp.held
        if isinstance(allow.friction, tuple):
            yield self._friction(*allow.friction)
        if allow.friction_share:
            found = self._less("friction", "friction_share", allow.friction_share, "", lambda v: v)
            yield replace(found, smooth=False)
        if allow.mass is not None and held is not None and allow.mass[1] > held.body.mass:
            yield self._mass(min(allow.mass[0], held.body.mass), allow.mass[1], held.body.mass)
        for key in ("load", "load_box"):
            values = np.asarray(getattr(allow, key))
            if np.any(values):
                yield self._wrenches(key, values, float(np.abs(values).max()))
        if self.asked.executes_samples:
            yield from self._sizes()
        if isinstance(allow.contact_gap, float) and allow.contact_gap > 0:
            yield self._less("tolerance", "contact_gap", allow.contact_gap, "m", lambda v: v)

    def _less(self, cause: Cause, key: str, value: float, unit: str, made: Callable[[float], Any]) -> Dial[Asked]:
        """Return a number that leaves more room when it is less."""

        def turned(number: float) -> Asked:
            return self.asked.with_task(allow=replace(self.allow, **{key: made(number)}))

        return Dial(cause, f"allow.{key}", value, unit, turned, "down", LEAST * value)

    def _sizes(self) -> Iterator[Dial[Asked]]:
        """Yield how far samples of the grasp may be off; that smaller ones help is likely, and nothing is proven."""
        scenarios = self.allow.scenarios
        assert scenarios is not None
        for key, cause, unit in SIZES:
            value = getattr(scenarios, key)
            if value > 0:
                found = self._less(cause, "scenarios", value, unit, partial(_sized, scenarios, key))
                yield replace(found, key=f"allow.scenarios.{key}", smooth=False, nested=False)

    def _friction(self, low: float, high: float) -> Dial[Asked]:
        found = self._less("friction", "friction", low, "", lambda v: (v, max(v, high)))
        return replace(
            found, eased="up", end=FRICTION_END * low, smooth=False,
            written=lambda v: f"[{v:.10g}, {max(v, high):.10g}]",
        )  # fmt: skip

    def _mass(self, low: float, high: float, own: float) -> Dial[Asked]:
        found = self._less("load", "mass", high, "kg", lambda v: (low, max(v, low)))
        return replace(found, end=own, written=lambda v: f'["{low:.10g} kg", "{max(v, low):.10g} kg"]')

    def _wrenches(self, key: str, values: Array, largest: float) -> Dial[Asked]:
        """Return all wrenches by one factor, told by their largest entry, in its unit where all have the same."""

        def written(value: float) -> str:
            scaled = np.array([float(f"{each * (value / largest):.10g}") for each in values.ravel()])
            return json.dumps(scaled.reshape(values.shape).tolist())

        forces, moments = np.any(values[..., :3]), np.any(values[..., 3:])
        unit = "" if forces and moments else "N" if forces else "N m"
        return replace(self._less("load", key, largest, unit, lambda v: values * (v / largest)), written=written)


def _sized(scenarios: Scenarios, key: str, value: float) -> Scenarios:
    """Return scenarios with another size of one kind."""
    sizes: dict[str, Any] = {key: value}
    return replace(scenarios, **sizes)
