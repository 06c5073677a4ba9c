"""From what a user asks for to a synergy set: a number, a name, names, a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from synergrip.errors import InputError, one_of
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.matrix import ALL, JOINTS, columns_of, stands_still
from synergrip.hands.synergies.synergy_file import SUFFIX, read_synergies


@dataclass(frozen=True)
class SetChoice:
    """The first synergies of a set."""

    set: str
    """Name of a set of the hand, or path of a synergy file."""
    first: int | None = None
    """How many; all of them when None."""


def select(
    hand: Hand, wish: int | str | Sequence[str] | SetChoice | None, key: str = "synergies", folder: Path = Path()
) -> SynergySet:
    """Return the synergies a user asks for.

    Args:
        hand: the hand.
        wish: nothing (the default set), a number K (the first K of the default set), the name of a set,
            ``"all"`` (every joint), the path of a synergy file (``.toml``), the first K of one of these, or a
            list of names of synergies of one set.
        key: where it stands, for the error.
        folder: what a path is relative to.

    Raises:
        InputError: an unknown name, a number below 1 or above n_z, names of different sets, no name, a name twice,
            a file that does not fit the hand (located in that file).
    """
    default = next(iter(hand.synergy_sets.values()))
    if wish is None:
        return default
    if isinstance(wish, SetChoice):
        chosen = _set(hand, wish.set, f"{key}.set", folder)
        return chosen if wish.first is None else first_of(chosen, wish.first, f"{key}.first")
    if isinstance(wish, str):
        return _set(hand, wish, key, folder)
    if isinstance(wish, int):
        every = "" if default.name == JOINTS else f'; write "{ALL}" for the {len(hand.joints)} joints'
        return first_of(default, wish, key, every)
    return _named(hand, list(wish), key)


def _set(hand: Hand, wish: str, key: str, folder: Path) -> SynergySet:
    if wish.endswith(SUFFIX):
        return read_synergies(folder / wish, hand.joint_names, hand.couplings, key=key)
    if wish not in hand.synergy_sets and wish != ALL:
        raise InputError.at(key, f"synergies {one_of(wish, [*hand.synergy_sets, ALL])}")
    return hand.synergy_sets[JOINTS if wish == ALL else wish]


def first_of(chosen: SynergySet, count: int, key: str, advice: str = "") -> SynergySet:
    """Return the set with its first `count` columns only.

    Raises:
        InputError: a number below 1 or above n_z, at `key`, with the `advice`.
    """
    available = len(chosen.synergies)
    if isinstance(count, bool) or not 1 <= count <= available:
        message = f"expected 1 to {available}, the number of synergies of '{chosen.name}', got {count}{advice}"
        raise InputError.at(key, message)
    return columns_of(chosen, chosen.synergies[:count])


def _named(hand: Hand, names: Sequence[str], key: str) -> SynergySet:
    if not names:
        raise InputError.at(key, "expected at least one synergy")
    for index, name in enumerate(names):
        if name in names[:index]:
            raise InputError.at(f"{key}[{index}]", f"'{name}' is listed twice")
        if not any(name in synergies.synergies for synergies in hand.synergy_sets.values()):
            known = dict.fromkeys(n for synergies in hand.synergy_sets.values() for n in synergies.synergies)
            raise InputError.at(f"{key}[{index}]", stands_still(hand, name) or one_of(name, known))
    for synergies in hand.synergy_sets.values():
        if all(name in synergies.synergies for name in names):
            return columns_of(synergies, names)
    raise InputError.at(key, f"no synergy set has all of {', '.join(names)}; use names of one set")
