"""Are the response maps known well enough for what rests on them? Words, and the check of a plan."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from synergrip.errors import SelfCheckError
from synergrip.planning.outcome import Check
from synergrip.statics.motion import Motion
from synergrip.statics.response import Response

SHOWN = 1e-8
"""Relative error from which on an answer tells of it."""
RELIED_ON = 1e-6
"""Relative error of the maps, and of the forces of a plan, beyond which no verdict is given."""
CANCELLED = 1e-7
"""Share of the terms that forces are sums of, below which they are measured against that share: no load, no squeeze."""
_RELIED_ON = ("dlambda_dzr", "dlambda_dw", "du_dzr", "du_dw", "dq_dzr", "dq_dw")
"""The maps that forces, motions and limits of a plan come from."""
_WORDS = {
    "lambda": "contact forces", "u": "object motion", "tau": "joint torques", "sigma": "actuator efforts",
    "z": "synergy displacements", "q": "joint displacements",
}  # fmt: skip
_CAUSES = {"dzr": "synergy references do", "dw": "the load does"}
_TOLD = {
    f"d{what}_{cause}": f"{does} to the {word}" for what, word in _WORDS.items() for cause, does in _CAUSES.items()
}
"""Map by its name -> what it says, in words."""


RESPONSE = "response"
"""How the check of the response is called."""


class InDoubtError(SelfCheckError):
    """What is known of a grasp does not suffice for a verdict."""


def accuracy_notes(response: Response) -> Iterator[str]:
    """Yield what is inaccurate, and what hangs on digits that the grasp's numbers do not have."""
    if response.doubt <= SHOWN:
        return
    known = response.accuracy
    name = max(known, key=lambda each: known[each].error)
    if known[name].error > SHOWN:
        yield (
            f"inaccurate: what {_TOLD[name]} may be wrong by {known[name].error:.0e} of its size, because the "
            "stiffnesses of the grasp differ by too many powers of ten; soften what is stiffest"
        )
    name = max(known, key=lambda each: known[each].sensitivity)
    if known[name].sensitivity > max(SHOWN, known[name].error):
        yield (
            f"sensitive: what {_TOLD[name]} changes by about {known[name].sensitivity:.0e} of its size with digits "
            "that the numbers of the grasp do not have, because it is almost rigid or almost free in some direction"
        )


def refuse_doubtful_response(response: Response) -> None:
    """Refuse to judge by maps that are not known well enough.

    Raises:
        InDoubtError: with the reason.
    """
    if response.doubt > RELIED_ON and max(response.accuracy[name].doubt for name in _RELIED_ON) > RELIED_ON:
        raise InDoubtError("; ".join(accuracy_notes(response)))


def refuse_doubtful_forces(response: Response, checks: Iterable[Check]) -> None:
    """Refuse to judge a motion whose forces are not known well enough, by its check of the response.

    Raises:
        InDoubtError: with the reason.
    """
    for check in checks:
        if check.name == RESPONSE and not check.passed:
            known = f"the forces of the plan are known to {check.error:.0e} of their size"
            why = f"{known}, too little to say that the limits hold"
            raise InDoubtError("; ".join((why, *accuracy_notes(response))))


def response_check(response: Response, motion: Motion, forces: float, terms: float) -> Iterator[Check]:
    """Yield the check of the response itself when there is anything to tell of it.

    Args:
        response: of the grasp.
        motion: what references and load do.
        forces: the largest contact force in it [N].
        terms: the largest of the terms that these are sums of [N].
    """
    unknown, size = _unknown(response, motion), max(forces, CANCELLED * terms)  # rounding of nothing is no doubt
    if unknown > SHOWN * size:
        yield Check(RESPONSE, unknown / size if size > 0 else np.inf, RELIED_ON)


def _unknown(response: Response, motion: Motion) -> float:
    """Return how far forces may be from the truth [N]."""
    of_references, of_load = response.accuracy["dlambda_dzr"], response.accuracy["dlambda_dw"]
    references = float(np.abs(motion.dz_r).sum(axis=1).max(initial=0.0))
    load = float(np.abs(response.scale.wrench(motion.wrench - response.grasp.w_0)).sum(axis=1).max(initial=0.0))
    return of_references.unknown * references + of_load.unknown * load
