"""The part of an MJCF file that a palm carries; the rest stands still."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.hands.models.mjcf import Actuator, Equality, Mjcf
from synergrip.hands.models.mjcf_springs import Spring
from synergrip.linalg import frozen


def carried_by(file: Mjcf, palm: int) -> tuple[Mjcf, list[int]]:
    """Return the file with the joints that body `palm` carries, and the bodies that it carries, parents first.

    A tendon that also passes joints that stand still moves the other ones alone.

    Raises:
        InputError: an equality that ties what the palm carries to what stands still; with file and line.
    """
    carried = set[int]()
    for body in range(1, file.model.nbody):  # parents come first
        if body != palm and int(file.model.body_parentid[body]) in carried | {palm}:
            carried.add(body)
    columns = [column for column, joint in enumerate(file.q) if int(file.model.jnt_bodyid[joint]) in carried]
    place = {column: number for number, column in enumerate(columns)}
    return replace(
        file,
        q=tuple(file.q[column] for column in columns),
        q_0=frozen(file.q_0[columns]),
        equalities=tuple(each for tie in file.equalities for each in _kept(file, tie, place, carried, palm)),
        tendons=frozen(file.tendons[:, columns]),
        actuators=tuple(_moved(each, place) for each in file.actuators),
        springs=tuple(each for spring in file.springs for each in _spring(file, spring, place)),
    ), sorted(carried)


def _kept(file: Mjcf, tie: Equality, place: dict[int, int], carried: set[int], palm: int) -> list[Equality]:
    """Return an equality with the new columns, or nothing when it holds only what stands still."""
    if tie.kind == "joint":
        inside = [end in place for end in tie.ends]
    elif tie.kind == "tendon":
        passed = np.flatnonzero(np.abs(file.tendons[list(tie.ends)]).max(axis=0)).tolist()
        inside = [column in place for column in passed] or [True]
    else:
        inside = [end in carried for end in tie.ends]
        return [tie] if any(inside) else []
    if any(inside) and not all(inside):
        raise tie.element.refused(
            f"this equality ties joints that the palm '{file.bodies[palm]}' carries to joints that stand still; choose "
            "a palm above all of them, or leave the equality out"
        )
    ends = tuple(place[end] for end in tie.ends) if tie.kind == "joint" and all(inside) else tie.ends
    return [replace(tie, ends=ends)] if all(inside) else []


def _moved(actuator: Actuator, place: dict[int, int]) -> Actuator:
    joint = None if actuator.joint is None else place.get(actuator.joint)
    return replace(actuator, joint=joint)


def _spring(file: Mjcf, spring: Spring, place: dict[int, int]) -> list[Spring]:
    """Return a spring with the new column; those of joints that stand still do nothing."""
    if spring.joint is None:
        return [spring]
    return [replace(spring, joint=place[spring.joint])] if spring.joint in place else []
