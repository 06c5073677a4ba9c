"""One number about a grasp and a task, between a plan that attains it and a proof that there is no more of it."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.documents.naming import made_by
from synergrip.planning.outcome import Plan
from synergrip.values import Value


@made_by("margins(grasp, task).direct")
@dataclass(frozen=True, eq=False, repr=False)
class DirectNumber(Value):
    """A number that is attained by a plan, and how much more of it there might be.

    Example:
        >>> heaviest = margins(grasp, task).direct["heaviest_kg"]  # doctest: +SKIP
        >>> heaviest.lower, heaviest.upper, heaviest.proven  # doctest: +SKIP
        (0.79, 0.79079, True)
    """

    name: str
    unit: str
    value: float | None
    """Attained by a verified plan, `plan`; None where there is no such number, or none was found."""
    lower: float | None
    """At least this: attained where much of it is good, proven where little is."""
    upper: float | None
    """At most this: proven where much of it is good, attained where little is; None where nothing is known."""
    proven: bool
    """Whether the end that is not attained is certified, of the linear model of the start posture."""
    why: str
    """Why there is no value, or what the end that is not attained is; in words."""
    setting: str = ""
    """The argument of ``--set`` that asks for the value."""
    plan: Plan | None = None
    """The plan that attains it."""
    displacement: tuple[float, ...] | None = None
    """(6,) of the object at the value about B [m, rad], of an amplitude along a rigid motion."""

    @classmethod
    def none(cls, name: str, unit: str, why: str) -> DirectNumber:
        """Return that there is no such number, and why."""
        return cls(name, unit, None, None, None, proven=False, why=why)
