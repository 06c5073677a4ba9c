"""From couplings and columns to S (9), and from what a user asks for to a synergy set and a posture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from synergrip.documents.quantities import SHOWN_IN
from synergrip.errors import InputError, Issue, one_of, raise_issues, suggest
from synergrip.hands.follower_ranges import FollowerRange, follower_ranges, why_outside
from synergrip.hands.hand import Coupling, Hand, Joint, SynergySet
from synergrip.hands.posture_units import unit_hint
from synergrip.hands.units import SI_UNITS, joint_kinds, misfits, synergy_kinds
from synergrip.linalg import Array, frozen

JOINTS = "joints"
"""The set every hand has: each joint is its own synergy (S = I)."""
ALL = "all"
"""What users call it."""
LIMIT_SLACK = 1e-9
"""[rad or m] by which a posture may pass a joint limit, for rounding."""


def coupling_map(joints: Sequence[str], couplings: Mapping[str, Coupling]) -> tuple[Array, Array]:
    """Return E (n_q, n_q) and e (n_q,) such that q = E q_free + e, whatever q_free holds for the followers.

    Raises:
        InputError: a follower or driver that is no joint, or followers that drive each other; the key is
            relative to the table of couplings.
    """
    index = {name: i for i, name in enumerate(joints)}
    for follower, coupling in couplings.items():
        if follower not in index:
            raise InputError.at(follower, one_of(follower, joints), on_key=True)
        for driver in coupling.ratios:
            if driver not in index:
                raise InputError.at(f"{follower}.joint", one_of(driver, joints))
    known: dict[str, tuple[Array, float]] = {}

    def resolve(joint: str, passed: tuple[str, ...]) -> tuple[Array, float]:
        """Return the row of E and the entry of e of a joint."""
        if joint in passed:
            raise InputError.at(f"{passed[0]}.joint", f"'{joint}' would follow itself")
        if joint not in couplings:
            return np.eye(len(joints))[index[joint]], 0.0
        if joint not in known:
            parts = [(k, *resolve(name, (*passed, joint))) for name, k in couplings[joint].ratios.items()]
            row = sum((k * row for k, row, _ in parts), np.zeros(len(joints)))
            known[joint] = row, couplings[joint].offset + sum(k * constant for k, _, constant in parts)
        return known[joint]

    for follower in couplings:
        resolve(follower, ())
    rows = [resolve(joint, ()) for joint in joints]
    return frozen([row for row, _ in rows]), frozen([constant for _, constant in rows])


def joint_vector(joints: Sequence[str], values: Mapping[str, float], followers: Mapping[str, Coupling]) -> Array:
    """Return (n_q,) with `values` by joint name and 0 elsewhere; followers may not be named.

    Raises:
        InputError: no joint, or a follower; the key is the name.
    """
    result = np.zeros(len(joints))
    for name, value in values.items():
        if name not in joints:
            raise InputError.at(name, one_of(name, joints), on_key=True)
        if name in followers:
            raise InputError.at(name, f"'{name}' follows {drivers(followers[name])}; name that one only", on_key=True)
        result[list(joints).index(name)] = value
    return result


def joint_set(joints: Sequence[str]) -> SynergySet:
    """Return the fully actuated hand as a synergy set: S = I, no effort limits."""
    return SynergySet(name=JOINTS, title="every joint by itself", synergies=tuple(joints), S=np.eye(len(joints)))


def joint_values(synergies: SynergySet, values: Mapping[str, float]) -> Array:
    """Return the joint values (n_q,) at the named synergy values; those left out are 0."""
    z = np.array([values.get(name, 0.0) for name in synergies.synergies])
    return frozen(synergies.S @ z + synergies.offset)


def resting(joints: Sequence[Joint], synergies: SynergySet) -> Array:
    """Return the joint values (n_q,) at z = 0, each brought inside the range of its joint."""
    lower, upper = ([getattr(joint, end) for joint in joints] for end in ("lower", "upper"))
    return frozen(np.clip(synergies.offset, lower, upper))


def columns_of(chosen: SynergySet, names: Sequence[str]) -> SynergySet:
    """Return the set with the named columns only, in that order."""
    picks = [chosen.synergies.index(name) for name in names]
    return replace(
        chosen,
        synergies=tuple(names),
        S=frozen(chosen.S[:, picks]),
        effort_limits=frozen(chosen.effort_limits[picks]),
    )


def posture(hand: Hand, synergies: SynergySet, wish: str | Mapping[str, float], key: str = "posture") -> Array:
    """Return the joint values (n_q,) of a posture.

    Args:
        hand: the hand.
        synergies: the chosen set; its names are looked up first.
        wish: the name of a posture of the hand, or values [rad or m] by synergy or joint name. Names left
            out are 0, or where springs alone hold them; a joint that follows another one follows unless it is named.
        key: where it stands, for the error.

    Raises:
        InputError: an unknown name, names of different kinds, units that do not suit a joint, a joint outside its
            limits.
    """
    if isinstance(wish, str):
        if wish not in hand.postures:
            raise InputError.at(key, f"posture {one_of(wish, hand.postures)}")
        q = hand.postures[wish]
    else:
        q = _values(hand, synergies, wish, key)
    issues = outside_limits(hand.joints, q, key, hand.couplings)
    raise_issues(issues)
    return frozen(q)


def _values(hand: Hand, synergies: SynergySet, wish: Mapping[str, float], key: str) -> Array:
    if not wish:
        raise InputError.at(key, "expected the value of at least one synergy or joint")
    keys = {name: f"{key}.{name}" for name in wish}
    chosen, kinds = set_named(hand, synergies, keys, key), joint_kinds(hand.joints)
    given = [(keys[name], name, value) for name, value in wish.items()]
    if chosen is not None:
        raise_issues(misfits(given, synergy_kinds(chosen, kinds.values()), "synergy"))
        return joint_values(chosen, wish)
    raise_issues(misfits(given, kinds))
    return joint_posture(hand.joint_names, {**_resting(hand), **wish}, hand.couplings)


def _resting(hand: Hand) -> dict[str, float]:
    """Return where springs hold the joints that nothing else moves."""
    sprung = hand.drives.sprung if hand.drives else {}
    return {name: rest for name, rest in sprung.items() if name not in hand.couplings}


def names_known(hand: Hand, synergies: SynergySet) -> tuple[str, ...]:
    """Return the names of synergies and joints that a hand answers to, those of the chosen set first."""
    return tuple(dict.fromkeys(name for each in _sets(hand, synergies) for name in each.synergies))


def set_named(hand: Hand, synergies: SynergySet, names: Mapping[str, str], key: str) -> SynergySet | None:
    """Return the first set that has all of some names, the chosen one first; None when they are names of joints.

    Args:
        hand: the hand.
        synergies: the chosen set.
        names: each name, with the key where it stands: one of its own, or `key` itself.
        key: where all of them stand, for the error.

    Raises:
        InputError: an unknown name, or names of different kinds.
    """
    known = names_known(hand, synergies)
    unknown = {name: at for name, at in names.items() if name not in known}
    raise_issues([
        Issue(stands_still(hand, name) or f"synergy or joint {one_of(name, known)}", key=at, on_key=at != key)
        for name, at in unknown.items()
    ])  # fmt: skip
    for each in _sets(hand, synergies):
        if each.name != JOINTS and all(name in each.synergies for name in names):
            return each
    if not all(name in hand.joint_names for name in names):
        raise InputError.at(key, "some names are of joints, some of synergies, or of two synergy sets; use one kind")
    return None


def stands_still(hand: Hand, name: str) -> str:
    """Return why a link or joint is no part of the hand though its file has it; empty for another name."""
    return f"'{name}' stands still: the palm '{hand.links[0]}' does not carry it" if name in hand.still else ""


def _sets(hand: Hand, synergies: SynergySet) -> tuple[SynergySet, ...]:
    """Return the chosen set and those of the hand; the last of them, "joints", names every joint."""
    return tuple({id(each): each for each in (synergies, *hand.synergy_sets.values())}.values())


def joint_posture(joints: Sequence[str], values: Mapping[str, float], couplings: Mapping[str, Coupling]) -> Array:
    """Return the joint values (n_q,) of `values` by joint name; a follower that is not named follows."""
    following = {name: coupling for name, coupling in couplings.items() if name not in values}
    E, e = coupling_map(joints, following)
    return frozen(E @ joint_vector(joints, values, {}) + e)


def ranges_of_followers(hand: Hand) -> list[FollowerRange]:
    """Return, for each follower, its own range and what its coupling makes of the range of its driver."""
    return follower_ranges(hand.joints, hand.couplings, *coupling_map(hand.joint_names, hand.couplings))


def outside_limits(
    joints: Sequence[Joint], q: Array, key: str, couplings: Mapping[str, Coupling] | None = None
) -> list[Issue]:
    """Return one issue for each joint that `q` (n_q,) puts outside its range; why, when `couplings` do it."""
    issues = []
    told = couplings or {}
    because = why_outside(joints, told, *coupling_map([joint.name for joint in joints], told), q)
    for joint, value in zip(joints, q, strict=True):
        if not joint.lower - LIMIT_SLACK <= value <= joint.upper + LIMIT_SLACK:
            factor, unit = SHOWN_IN[SI_UNITS[joint.kind]]
            lower, upper, found = joint.lower * factor, joint.upper * factor, value * factor
            message = f"joint '{joint.name}' would be at {found:.4g} {unit}, outside {lower:.4g} to {upper:.4g} {unit}"
            message += f"; {because[joint.name]}" if joint.name in because else unit_hint(joint, float(value))
            issues.append(Issue(message, key=key))
    return issues


def override(
    couplings: Mapping[str, Coupling], wish: Mapping[str, float] | float | None, key: str
) -> dict[str, Coupling]:
    """Return `couplings` with the ratios a user asks for: one for all followers, or by follower.

    Raises:
        InputError: a joint that follows none, or a ratio for a hand whose joints follow none; at `key`.
    """
    if wish is None:
        return dict(couplings)
    if not couplings:
        raise InputError.at(key, "no joint of this hand follows another one; leave the coupling out", on_key=True)
    if not isinstance(wish, Mapping):
        return {name: _with_ratio(name, each, wish, key) for name, each in couplings.items()}
    for name in wish:
        if name not in couplings:
            listed = ", ".join(couplings)
            message = f"'{name}' follows no other joint (followers: {listed}){suggest(name, couplings)}"
            raise InputError.at(f"{key}.{name}", message, on_key=True)
    changed = {name: _with_ratio(name, couplings[name], wish[name], f"{key}.{name}") for name in wish}
    return {**couplings, **changed}


def _with_ratio(name: str, coupling: Coupling, ratio: float, key: str) -> Coupling:
    if len(coupling.ratios) != 1:
        raise InputError.at(key, f"'{name}' follows {drivers(coupling)}; one ratio does not say how")
    return replace(coupling, ratios=dict.fromkeys(coupling.ratios, float(ratio)), place=key)


def drivers(coupling: Coupling) -> str:
    """Return the names of the joints that are followed, as text."""
    return " and ".join(f"'{name}'" for name in coupling.ratios) or "no joint (it is locked)"
