"""The springs of a compiled MJCF file: those in joints, and those in tendons."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Spring:
    """A spring in a joint or in a tendon."""

    name: str
    """As in "joint 'knuckle'"."""
    joint: int | None
    """Column of q; None for a tendon."""
    tendon: int | None
    stiffness: float  # [N m/rad] or [N/m]
    rest: float
    """Joint value, or length of the tendon, at which it gives no force [rad or m]."""
    unread: str
    """Why it is none that is linear about one rest; empty for one that is read."""


def joint_springs(model: Any, q: tuple[int, ...], names: tuple[str, ...], tuned: NDArray[np.bool_]) -> Iterator[Spring]:
    """Yield the springs in the joints `q` of a model; those that are `tuned` have a stiffness made of inertias."""
    for column, joint in enumerate(q):
        stiffness, rest = model.jnt_stiffness[joint], model.qpos_spring[model.jnt_qposadr[joint]]
        unread = "springdamper needs inertias, which are not read here; write stiffness" if tuned[joint] else ""
        unread = unread or _bent(model, "jnt", joint)
        if stiffness > 0 or unread:
            yield Spring(f"joint '{names[joint]}'", column, None, float(stiffness), float(rest), unread)


def tendon_springs(model: Any) -> Iterator[Spring]:
    """Yield the springs in the tendons of a model."""
    for tendon in range(model.ntendon):
        stiffness, (rest, end) = model.tendon_stiffness[tendon], model.tendon_lengthspring[tendon]
        unread = "springlength leaves it slack over a range" if rest < end else _bent(model, "tendon", tendon)
        if stiffness > 0:
            name = f"tendon '{model.tendon(tendon).name or tendon + 1}'"
            yield Spring(name, None, tendon, float(stiffness), float(rest), unread)


def _bent(model: Any, kind: str, number: int) -> str:
    """Return why a spring is not linear: MuJoCo 4 knows polynomials, and springs that yield."""
    known = [getattr(model, f"{kind}_{what}", None) for what in ("stiffnesspoly", "springyield")]
    return "it is not linear" if any(each is not None and np.any(each[number]) for each in known) else ""
