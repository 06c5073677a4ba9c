"""What is asked of a hand by itself: posture, synergies, closing and compliances, all judged at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from synergrip.documents.gathering import gathered
from synergrip.documents.judging import Arguments, as_numbers, described
from synergrip.errors import InputError, Issue, raise_issues
from synergrip.grasps.closing_direction import closing_direction
from synergrip.grasps.matrix_reading import LARGEST_COMPLIANCE
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.matrix import outside_limits
from synergrip.hands.synergies.matrix import posture as posture_of
from synergrip.hands.synergies.select import SetChoice, select
from synergrip.hands.undriven import judge_undriven, with_springs
from synergrip.linalg import Array, frozen
from synergrip.values import Value

Posture = str | Mapping[str, float] | Sequence[float] | Array
Synergies = int | str | Sequence[str] | SetChoice | SynergySet


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class AskedHand(Value):
    """How a hand is to hold, whatever it is to hold."""

    synergies: SynergySet
    q: Array
    """(n_q,) the posture from which the hand closes, or in which it holds the object [rad or m]."""
    closing: Array | None
    """(n_q,) joint motion of closing by 1; None for a hand that stays in its posture."""
    C_q: Array  # (n_q, n_q) [rad/(N m)]
    C_z: Array  # (n_z, n_z)


def asked_hand(
    hand: Hand,
    *,
    posture: Posture | None,
    synergies: Synergies | None,
    close: str | Mapping[str, float] | None,
    joint_compliance: float | Sequence[float] | Array | None,
    synergy_compliance: float | Sequence[float] | Array,
    links: Sequence[str],
    folder: Path,
) -> AskedHand:
    """Return what is asked of a hand; arguments as of `make_grasp`, `links` are those that touch.

    Raises:
        InputError: all of it that is wrong, once the synergies are known.
    """
    chosen = _synergies(hand, synergies, folder)
    asked = not (synergies is None or isinstance(synergies, int))
    yielding = as_numbers(joint_compliance)
    each_yields = yielding is not None and yielding.ndim > 0
    issues = list[Issue]()
    gathered(issues, lambda: judge_undriven(hand, chosen, links, asked=asked, each_yields=each_yields, key="synergies"))
    q = gathered(issues, lambda: _joint_values(hand, chosen, posture))
    C_q = gathered(issues, lambda: _joint_compliance(hand, joint_compliance))
    C_z = gathered(issues, lambda: diagonal(synergy_compliance, chosen.synergies, "synergy_compliance", "synergies"))
    direction = None
    if close is not None:
        direction = gathered(issues, lambda: closing_direction(hand, chosen, _wish(close)))
    if issues or q is None or C_q is None or C_z is None:
        raise InputError(issues)
    return AskedHand(synergies=chosen, q=q, closing=direction, C_q=C_q, C_z=C_z)


def _synergies(hand: Hand, wish: Synergies | None, folder: Path) -> SynergySet:
    if isinstance(wish, SynergySet):
        if wish.S.shape[0] != len(hand.joints):
            message = f"'{wish.name}' has {wish.S.shape[0]} rows for the {len(hand.joints)} joints of the hand"
            raise InputError.at("synergies", message)
        return wish
    if wish is not None and (isinstance(wish, bool) or not isinstance(wish, int | str | SetChoice | Sequence)):
        message = f"expected a number of synergies, a name, a file, a list of names or a set, got {described(wish)}"
        raise InputError.at("synergies", message)
    return select(hand, wish, "synergies", folder)


def _wish(close: object) -> str | Mapping[str, float]:
    """Return what the hand closes along, when it is a name or weights by name."""
    judge = Arguments("")
    if not isinstance(close, str | Mapping) or not close:
        message = "expected the name of a synergy or joint, with '-' in front for the opposite direction, or weights by"
        raise InputError.at("close", f"{message} name such as {{'s1': -1, 's2': 0.2}}, got {described(close)}")
    for name, weight in close.items() if isinstance(close, Mapping) else ():
        judge.number(f"close.{name}", weight)
    judge.finish()
    return close


def _joint_values(hand: Hand, synergies: SynergySet, wish: object) -> Array:
    """Return the joint values (n_q,) of a posture by name, by values or as an array."""
    if wish is None:
        names = ", ".join(hand.postures)
        raise InputError.at("posture", f"missing; name one of {names}, or give joint values", on_key=True)
    if isinstance(wish, str):
        return posture_of(hand, synergies, wish, "posture")
    judge = Arguments("")
    if isinstance(wish, Mapping):
        for name, value in wish.items():
            judge.number(f"posture.{name}", value, unit="rad or m")
        judge.finish()
        return posture_of(hand, synergies, wish, "posture")
    q = judge.array("posture", wish, (len(hand.joints),), f": a value for each of {', '.join(hand.joint_names)}")
    judge.finish()
    raise_issues(outside_limits(hand.joints, q, "posture", hand.couplings))
    return q


def _joint_compliance(hand: Hand, wish: float | Sequence[float] | Array | None) -> Array:
    if wish is None:
        return hand.C_q
    C_q = diagonal(wish, hand.joint_names, "joint_compliance", "joints")
    return with_springs(hand, C_q) if hand.drives is not None and np.ndim(wish) == 0 else C_q


def diagonal(value: float | Sequence[float] | Array, names: Sequence[str], key: str, what: str) -> Array:
    """Return a compliance matrix of one value for all names, or of one for each.

    Raises:
        InputError: no numbers, negative ones or ones beyond all compliances, or not as many as names.
    """
    judge = Arguments("")
    found = judge.numbers(key, value, f"a number, or one for each of the {what}")
    judge.finish()
    if found is None or found.ndim > 1:
        raise InputError.at(key, f"expected a number or {len(names)} numbers, got {described(found)}")
    if found.ndim and len(found) != len(names):
        raise InputError.at(key, f"{len(found)} values for {len(names)} {what} ({', '.join(names)})")
    if found.min(initial=0.0) < 0:
        raise InputError.at(key, f"a compliance must not be negative, got {found.min():g}")
    if found.max(initial=0.0) > LARGEST_COMPLIANCE:
        raise InputError.at(key, f"a compliance of {found.max():g} is too large")
    return frozen(np.diag(np.broadcast_to(found, (len(names),))))
