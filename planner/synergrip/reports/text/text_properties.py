"""The properties of a grasp by their textbook names, as text for people."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.documents.quantities import plain
from synergrip.documents.words import listed
from synergrip.linalg import GREY_CEILING, GREY_FLOOR, Array
from synergrip.planning.free import free_dimensions
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_analysis import WIDTH, combination
from synergrip.statics.effects import ReferenceEffect
from synergrip.statics.ellipsoids import Ellipsoid
from synergrip.statics.grasp_properties import GraspProperties
from synergrip.statics.twists import describe_twist

MOST, FEW = 6, 3
"""Principal values that a line shows, and squeezes that are told one by one."""

ALIKE = 1e-6
"""Relative difference up to which principal values are the same, and their axes no one's in particular."""


def properties_text(found: GraspProperties) -> str:
    """Return classes, squeezes, stiffness, manipulability and distances to singularity, and where they are from."""
    parts = (_classes(found), _effects(found), _ellipsoids(found), _distances(found), _sources(found))
    return "\n\n".join("\n".join(part) for part in parts)


def _classes(found: GraspProperties) -> Iterator[str]:
    rows = [
        (joints.name, joints.formula, str(joints.dimension), synergies.formula, str(synergies.dimension),
         synergies.meaning)
        for joints, synergies in zip(found.of_joints.values(), found.of_synergies.values(), strict=True)
    ]  # fmt: skip
    names = [row[0] for row in rows if row[4] != "0"]
    yield f"the grasp, as its synergies drive it, is {listed(names) if names else 'none of these'}: dimensions above 0"
    yield table(("", "all joints", "dim", "synergies", "dim", "which are"), rows, right=(2, 4))
    if found.ambiguous:
        yield f"ambiguous: a singular value lies between {GREY_FLOOR:.0e} and {GREY_CEILING:.0e} of the largest"
    for note in free_dimensions(found.analysis):
        yield from wrapped("note     ", note, WIDTH)


def _effects(found: GraspProperties) -> Iterator[str]:
    effects = list(found.effects.values())
    rows = [(each.name, str(each.dimension), each.formula, each.meaning) for each in effects]
    yield f"what references do: n_z = {found.analysis.grasp.n_z} is the sum"
    yield table(("", "dim", "", "which is"), rows, right=(1,))
    for each in effects:
        yield from _columns(found, each)


def _columns(found: GraspProperties, effect: ReferenceEffect) -> Iterator[str]:
    """Yield, of squeezes, which references make each newton of them, and how far the object goes."""
    if not effect.name.endswith("squeeze"):
        return
    analysis = found.analysis
    shown = zip(effect.references.T[:FEW], effect.motions.T[:FEW], strict=True)
    for i, (references, motion) in enumerate(shown):
        text = combination(references, analysis.grasp.synergies)
        if np.any(motion):
            size = 1e3 * float(np.linalg.norm(analysis.response.scale.twist(motion)))
            moved = describe_twist(motion, analysis.grasp.contacts, analysis.response.scale.length)
            text += f": {plain(size, 3)} mm per newton, {moved}"
        yield from wrapped(f"{effect.name.removesuffix(' squeeze')} {i + 1}  ", text, WIDTH)
    if effect.dimension > FEW:
        yield f"and {effect.dimension - FEW} more, in the JSON document"


def _ellipsoids(found: GraspProperties) -> Iterator[str]:
    rows = [(each.name, _values(each.values), each.unit, each.formula) for each in found.ellipsoids.values()]
    yield "how it yields at the start posture, and what references of size 1 do there (manipulability): half axes"
    yield table(("", "values", "unit", "of"), rows)
    for name, ellipsoid in (("stiffest", found.ellipsoids["stiffness"]), ("softest", found.ellipsoids["compliance"])):
        yield from wrapped(f"{name:9}", _direction(found, ellipsoid), WIDTH)
    length = 1e3 * found.analysis.response.scale.length
    text = (
        f"what has translations and rotations in one compares them by the length of the grasp, {plain(length)} mm; "
        "F is the force map and U the motion map of the references, and their unit that of the synergies"
    )
    yield from wrapped("         ", text, WIDTH)


def _direction(found: GraspProperties, ellipsoid: Ellipsoid) -> str:
    """Return the direction of the largest value; where several are as large, how many there are."""
    value, analysis = ellipsoid.values[0], found.analysis
    size = "not resisted at all" if np.isinf(value) else f"{plain(value)} {ellipsoid.unit}"
    alike = int(np.sum(ellipsoid.values >= value * (1 - ALIKE)))
    if alike > 1:
        return f"{alike} directions alike: {size}"
    return f"{describe_twist(ellipsoid.axes[:, 0], analysis.grasp.contacts, analysis.response.scale.length)}: {size}"


def _values(values: Array) -> str:
    shown = [plain(value) for value in values[:MOST]]
    return "  ".join([*shown, *([f"and {len(values) - MOST} more"] if len(values) > MOST else [])])


def _distances(found: GraspProperties) -> Iterator[str]:
    rows = [(each.name, plain(each.smallest), each.unit, f"{each.relative:.3g}",
             f"{each.decision.rank} of {each.full}", each.formula, each.meaning)
            for each in found.singularity.values()]  # fmt: skip
    yield "distance to singularity: smallest singular value, and through the largest"
    yield table(("", "smallest", "unit", "relative", "rank", "of", "above 0 means that"), rows)


def _sources(found: GraspProperties) -> Iterator[str]:
    groups = (
        ("classes", [each.source for each in found.of_joints.values()]),
        ("references", [each.source for each in found.effects.values()]),
        ("ellipsoids", [each.source for each in found.ellipsoids.values()]),
        ("distance", [each.source for each in found.singularity.values()]),
    )
    yield "sources"
    for name, named in groups:
        for source in dict.fromkeys(named):
            yield from wrapped(f"  {name:12}", source, WIDTH)
