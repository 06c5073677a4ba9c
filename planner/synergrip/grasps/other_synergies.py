"""A grasp whose hand has other synergies: some of its own only, or further ones beside them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp
from synergrip.hands.hand import SynergySet
from synergrip.linalg import Array, block_diagonal, frozen

Origins = Sequence[int | None]
"""For each synergy of a new grasp its place among those of the old one; None for one that is new."""


def chosen(grasp: Grasp, picks: Sequence[int]) -> Grasp:
    """Return the grasp with some of its synergies.

    Args:
        grasp: the grasp.
        picks: places of the columns of S that stay, in the new order.

    Raises:
        InputError: none, or places that there are not.
    """
    places = list(picks)
    known = range(grasp.n_z)
    wrong = [place for place in places if place not in known]
    if wrong:
        raise InputError.at("picks", one_of(wrong[0], map(str, known)))
    names = tuple(grasp.synergies[place] for place in places)
    return _with(grasp, names, grasp.S[:, places], grasp.C_z[np.ix_(places, places)], places)


def extended(grasp: Grasp, names: Sequence[str], columns: Array) -> Grasp:
    """Return the grasp with further synergies, which do not yield and have no limit of effort.

    The response to its own synergies stays what it is, so that all it could do it still can.

    Args:
        grasp: the grasp.
        names: of the further synergies; a name that the grasp has gets a ``+`` behind it.
        columns: (n_q, k) what is appended to S.

    Raises:
        InputError: columns that do not fit the joints or the names.
    """
    taken = list(grasp.synergies)
    for name in names:
        while name in taken:
            name = f"{name}+"
        taken.append(name)
    wanted = (grasp.n_q, len(names))
    if np.shape(columns) != wanted:
        raise InputError.at("columns", f"expected shape {wanted}, got {np.shape(columns)}")
    C_z = block_diagonal([grasp.C_z, np.zeros((len(names), len(names)))])
    origins = [*range(grasp.n_z), *([None] * len(names))]
    return _with(grasp, tuple(taken), np.hstack([grasp.S, columns]), C_z, origins)


def _with(grasp: Grasp, names: tuple[str, ...], S: Array, C_z: Array, origins: Origins) -> Grasp:
    held = grasp.held
    if held is not None:
        limits = held.synergies.effort_limits
        kept = np.array([np.inf if at is None or at >= len(limits) else limits[at] for at in origins])
        synergies = replace(held.synergies, synergies=names, S=frozen(S), effort_limits=frozen(kept))
        held = replace(held, synergies=synergies)
    return replace(grasp, S=frozen(S), C_z=frozen(C_z), synergies=names, held=held)


def of_whole_set(grasp: Grasp) -> tuple[Grasp, Origins]:
    """Return the grasp with all synergies of the set that its own are of, in the order of the set, and their origins.

    Those that it has not yield as its own do, where these yield alike, or else not at all. A grasp whose synergies are
    of no set that its hand names stays as it is.
    """
    own = list(range(grasp.n_z))
    known = None if grasp.held is None else grasp.held.hand.synergy_sets.get(grasp.held.synergies.name)
    if known is None or len(known.S) != grasp.n_q:
        return grasp, own
    places = _places(grasp, known)
    if sorted(at for at in places if at is not None) != own:
        return grasp, own
    return of_set(grasp, known)


def of_set(grasp: Grasp, chosen: SynergySet) -> tuple[Grasp, Origins]:
    """Return the grasp with the synergies of a set in place of its own, and where each of them was among these.

    Those that it has not yield as its own do, where these yield alike, or else not at all.

    Args:
        grasp: on a hand.
        chosen: with a row for each joint of it.
    """
    places = _places(grasp, chosen)
    alike = np.array_equal(grasp.C_z, grasp.C_z[0, 0] * np.eye(grasp.n_z))
    C_z = (grasp.C_z[0, 0] if alike else 0.0) * np.eye(len(places))
    kept = [i for i, at in enumerate(places) if at is not None]
    C_z[np.ix_(kept, kept)] = grasp.C_z[np.ix_(*[[at for at in places if at is not None]] * 2)]
    whole = _with(grasp, chosen.synergies, chosen.S, C_z, places)
    if whole.held is not None:
        whole = replace(whole, held=replace(whole.held, synergies=chosen))
    return whole, places


def _places(grasp: Grasp, chosen: SynergySet) -> list[int | None]:
    """Return where each synergy of a set is among those of a grasp; None for one that it has not."""
    return [_place(grasp, name, column) for name, column in zip(chosen.synergies, chosen.S.T, strict=True)]


def _place(grasp: Grasp, name: str, column: Array) -> int | None:
    """Return which synergy of a grasp is the one of a set; None when none is."""
    at = grasp.synergies.index(name) if name in grasp.synergies else None
    return at if at is not None and np.array_equal(grasp.S[:, at], column) else None
