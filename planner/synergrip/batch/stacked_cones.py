"""Friction cones of many problems: one matrix for all, or one for each where friction or contacts differ."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from operator import attrgetter

import numpy as np

from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.friction_cones import Cones
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array


def stacked_cones(grasps: Sequence[Grasp], friction: Array | None) -> tuple[Cones, ...]:
    """Return the cones of one grasp, or of N, with friction multiplied by (N,) factors; half-lines first."""
    first, kinds = grasps[0], list(map(attrgetter("kind"), chain.from_iterable(map(attrgetter("contacts"), grasps))))
    every = [
        (contact, W.shape[-2], W) for contact in range(first.n_c) for W in _cones(kinds[contact :: first.n_c], friction)
    ]
    leading = (len(grasps),) if len(grasps) > 1 else (() if friction is None else (len(friction),))
    found = []
    for size in sorted({size for _, size, _ in every}):
        chosen = [each for each in every if each[1] == size]
        W = np.zeros((*leading, len(chosen) * size, first.n_l))
        for k, (contact, _, own) in enumerate(chosen):
            W[..., k * size : (k + 1) * size, first.rows[contact]] = own
        found.append(Cones(size, np.array([contact for contact, *_ in chosen]), W))
    return tuple(found)


def _cones(kinds: Sequence[ContactKind], friction: Array | None) -> tuple[Array, ...]:
    """Return the cones (..., d, rows) of one contact in all grasps; each class of contacts makes its own at once."""
    classes: list[type[ContactKind]] = list(dict.fromkeys(map(type, kinds)))
    if len(classes) == 1:
        return classes[0].cones_with(_values(kinds, friction))
    which = np.array([classes.index(type(kind)) for kind in kinds])
    whole: list[Array] = []
    for i, each in enumerate(classes):
        places = np.flatnonzero(which == i)
        own = each.cones_with(
            _values([kinds[k] for k in places.tolist()], None if friction is None else friction[places])
        )
        whole = whole or [np.empty((len(kinds), *W.shape[-2:])) for W in own]
        for every, W in zip(whole, own, strict=True):
            every[places] = W
    return tuple(whole)


def _values(kinds: Sequence[ContactKind], friction: Array | None) -> dict[str, Array]:
    """Return the parameters () or (N,) of contacts of one class, those of friction multiplied by factors."""
    first = kinds[0]
    values = {name: np.fromiter(map(attrgetter(name), kinds), float, len(kinds)) for name in first.named()}
    if len(kinds) == 1:
        values = {name: value[0] for name, value in values.items()}
    for name in first.frictions if friction is not None else ():
        if name in values:
            values[name] = values[name] * friction
    return values


def most(cones: Sequence[Cones], grasp: Grasp) -> Array:
    """Return (n_l,) or (N, n_l) the largest size of each force component for a newton of normal force, by the cones."""
    leading = cones[0].W.shape[:-2]
    result = np.ones((*leading, grasp.n_l))
    for contact, rows in enumerate(grasp.rows):
        tails, heads = [], []
        for each in cones:
            for k in np.flatnonzero(each.contacts == contact):
                own = each.W[..., k * each.size : (k + 1) * each.size, rows]
                tails.append(own[..., 1:, 1:])
                heads.append(np.broadcast_to(own[..., :1, 0], (*own.shape[:-2], each.size - 1)))
        result[..., rows.start + 1 : rows.stop] = _reached(np.concatenate(tails, -2), np.concatenate(heads, -1))
    return result


def _reached(tail: Array, head: Array) -> Array:
    """Return ``|pinv(tail)| head``; most tails are diagonal."""
    size = min(tail.shape[-2:])
    diagonal = np.diagonal(tail, axis1=-2, axis2=-1)
    if tail.shape[-2] == tail.shape[-1] and np.count_nonzero(tail) == np.count_nonzero(diagonal) == diagonal.size:
        return np.asarray(head / np.abs(diagonal))
    return np.asarray((np.abs(np.linalg.pinv(tail)) @ head[..., None])[..., 0]) if size else head[..., :0]
