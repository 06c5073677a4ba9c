"""What is known of a no."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.changes.asked import Posed
from synergrip.conic.conflicts import Conflict
from synergrip.conic.limits.dial import Cause
from synergrip.documents.naming import made_by
from synergrip.errors import InterruptError
from synergrip.explain.repairs import Repair
from synergrip.explain.synergies.missing_synergies import MissingSynergies
from synergrip.explain.when import When
from synergrip.values import Value

STAGES: dict[str, Cause] = {"restraint": "restraint", "count": "count", "direction": "direction", "reach": "reach"}
"""What is to blame where no limit is."""


@made_by("answer.explain()")
@dataclass(frozen=True, eq=False, repr=False)
class Explanation(Value):
    """What is known of a no.

    Example:
        >>> refused.explanation.cause  # of an `Infeasible`  # doctest: +SKIP
        'force_cap'
    """

    cause: Cause
    """What is blamed: the cause of the smallest change that helps, or the stage where no number does."""
    text: str
    conflicts: tuple[Conflict, ...]
    """What clashes: first what is blamed where it is a limit, then the largest share of the proof first."""
    repairs: tuple[Repair, ...]
    """Changes that give the linear model of the start posture a plan, the smallest first; each says whether there is a
    verified plan with it."""
    cannot_help: tuple[Cause, ...]
    """Causes of which it is proven that no value of theirs leaves a plan, in the linear model of the start posture; but
    for those of which a plan of the hand that moves was found."""
    when: When
    whole: bool
    """Whether all changes were planned again; the short form does so with the smallest."""
    interrupted: bool = False
    """Whether somebody stopped it; what it says was found by then."""
    missing_synergies: MissingSynergies | None = None
    """The fewest columns beside S that give a plan, and who has such columns; None where that was not looked at. In the
    short form candidates are judged in the linear model of the start posture."""
    posed: Posed | None = None
    """The task as a program of the start posture; None where it is refused before there is one."""
    pairs: tuple[tuple[Repair, Repair], ...] = ()
    """Pairs of changes with a verified plan, where no single one has, in the long form; where the start posture needs
    the first one, it is 5 % more than that."""
    clashing: tuple[str, ...] | None = None
    """Keys of limits that cannot hold together and of which none can be left out; empty where physics alone leaves no
    plan, None where it is not known, as in the short form."""
    moves: bool = False
    """Whether it is about a hand that is linearised anew along its motion: the start posture proves nothing of that."""
    others: tuple[Repair, ...] = ()
    """Changes with a verified plan that are not the least of their kind: of the friction of single contacts and of
    stiffness, in the long form; of every number, where only the hand that moves has no plan."""

    def exit_code(self, answer: int) -> int:
        """Return the exit code of the answer that it explains, or that of an interrupt of the search for changes."""
        return InterruptError.exit_code if self.interrupted else answer
