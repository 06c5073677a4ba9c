"""Two synergy sets on the same joints: of one hand, or of two files whose joints are matched by name."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from synergrip.errors import InputError
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.select import first_of, select
from synergrip.hands.synergies.synergy_file import SUFFIX, read_synergies, read_synergy_file


@dataclass(frozen=True, eq=False)
class Pair:
    """Two sets whose S has a row for each of the same joints."""

    joints: tuple[str, ...]
    first: SynergySet
    second: SynergySet
    only_first: tuple[str, ...] = ()
    """Joints that the second file leaves out, so that its synergies do not move them."""
    only_second: tuple[str, ...] = ()


def pair_of_hand(hand: Hand, first: str, second: str, count: int | None, keys: tuple[str, str, str]) -> Pair:
    """Return two sets of a hand, each a name or the path of a synergy file.

    Args:
        hand: the hand.
        first: one set.
        second: the other one.
        count: how many of the synergies of each; all when None.
        keys: what names the sets and the count, for errors.

    Raises:
        InputError: an unknown set, a file that does not fit the hand, fewer than `count` synergies.
    """
    sets = [_cut(select(hand, wish, key), count, keys[2]) for wish, key in zip((first, second), keys[:2], strict=True)]
    return Pair(hand.joint_names, sets[0], sets[1])


def pair_of_files(first: str, second: str, count: int | None, keys: tuple[str, str, str]) -> Pair:
    """Return the sets of two synergy files, on the joints that either names; without couplings.

    Args:
        first: path of one file.
        second: path of the other one.
        count: how many of the synergies of each; all when None.
        keys: what names the files and the count, for errors.

    Raises:
        InputError: a path that is no synergy file, no joint in common, fewer than `count` synergies.
    """
    for path, key in zip((first, second), keys[:2], strict=True):
        if not path.endswith(SUFFIX):
            raise InputError.at(key, f"without a hand both sets are files that end in {SUFFIX}, got {path!r}")
    a, b = (read_synergy_file(Path(path), key).joints for path, key in zip((first, second), keys[:2], strict=True))
    if not set(a) & set(b):
        raise InputError.at(keys[1], f"the files have no joint in common; '{first}' begins with '{a[0]}', not '{b[0]}'")
    joints = tuple(dict.fromkeys((*a, *b)))
    sets = [_cut(read_synergies(Path(path), joints, {}), count, keys[2]) for path in (first, second)]
    only = [tuple(name for name in joints if name not in other) for other in (b, a)]
    return Pair(joints, sets[0], sets[1], only[0], only[1])


def _cut(chosen: SynergySet, count: int | None, key: str) -> SynergySet:
    return chosen if count is None else first_of(chosen, count, key)
