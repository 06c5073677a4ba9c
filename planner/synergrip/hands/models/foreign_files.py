"""Files that people name as a hand and that are none: what each is, and what to do instead."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from synergrip.hands.models.xml_elements import Element

XACRO = ".xacro"
_NAMESPACES = ("http://www.ros.org/wiki/xacro", "http://ros.org/wiki/xacro", "http://wiki.ros.org/xacro")
_OF_OLD = ("include", "macro", "property")
"""Macros in the outermost element that early versions of xacro took without their prefix."""
_PLACES = ("filename", "file", "uri", "url")
"""Attributes that name files, which are not read."""

_MESH = "a mesh, which has no joints; give the URDF or MJCF that uses it"
_USD = "a USD scene; give the URDF or MJCF that it was made from, or export it as one of them (Isaac Sim can, to URDF)"
_SDF = "an SDF model (Gazebo); give the URDF that it was made from, or convert it to one (ROS 2: sdformat_urdf)"
_ARCHIVE = "an archive; unpack it and name the URDF or MJCF inside"
_LIST = "no robot description; give a URDF or an MJCF"

SUFFIXES = {
    ".sdf": _SDF, ".world": _SDF,
    ".usd": _USD, ".usda": _USD, ".usdc": _USD, ".usdz": _USD,
    ".mjb": "a model that MuJoCo has compiled; give the MJCF (.xml) that it was compiled from",
    ".srdf": "a list of groups and poses of a robot (MoveIt); give the URDF that it belongs to",
    ".stl": _MESH, ".obj": _MESH, ".dae": _MESH, ".ply": _MESH, ".glb": _MESH, ".gltf": _MESH, ".fbx": _MESH,
    ".step": _MESH, ".stp": _MESH,
    ".zip": _ARCHIVE, ".tar": _ARCHIVE, ".gz": _ARCHIVE, ".tgz": _ARCHIVE, ".bz2": _ARCHIVE, ".xz": _ARCHIVE,
    ".yaml": _LIST, ".yml": _LIST, ".json": _LIST, ".csv": _LIST,
    ".toml": "not called hand.toml; give a hand a folder of its own with a hand.toml, and name the folder",
}  # fmt: skip
"""What a file is whose name ends so."""

ROOTS = {
    "sdf": f"this is {_SDF}",
    "mujocoinclude": "this is a part that another MJCF includes; name the one that includes it",
    "COLLADA": f"this is {_MESH}",
    "launch": "this is a ROS launch file; give the URDF that it loads",
    "package": "this describes a ROS package; give the URDF in it",
}
"""What a file is whose outermost element is called so."""


def said_by_name(path: Path) -> str:
    """Return what is wrong with a file by its name alone; empty when its content is to decide."""
    suffix = path.suffix.lower()
    if suffix == XACRO:
        return f"'{path.name}' is a file of xacro macros; {expand(path)}"
    return f"'{path.name}' is {SUFFIXES[suffix]}" if suffix in SUFFIXES else ""


def expand(path: Path) -> str:
    """Return how xacro macros become a URDF or MJCF."""
    bare = path.with_suffix("") if path.suffix.lower() == XACRO else path.with_suffix(f".plain{path.suffix}")
    result = bare if bare.suffix else bare.with_suffix(".urdf")
    return f"expand it first, with `xacro {path.name} > {result.name}` (a tool of ROS), and name the result"


def refuse_macros(root: Element) -> None:
    """Refuse a file with xacro macros in it, whatever its name.

    Raises:
        InputError: at the first element that only xacro understands.
    """
    prefixes = ["xacro"] + [
        name.removeprefix("xmlns:")
        for name, value in root.attributes.items()
        if name.startswith("xmlns:") and value.rstrip("/#") in _NAMESPACES
    ]
    starts = tuple(f"{prefix}:" for prefix in prefixes)
    of_old = [id(child) for child in root.children if root.tag == "robot" and child.tag in _OF_OLD]
    for element in _all(root):
        if element.tag.startswith(starts) or id(element) in of_old:
            raise element.refused(f"<{element.tag}> is a xacro macro; {expand(root.path)}")
        for name, value in element.attributes.items():
            if ("${" in value or "$(" in value) and name not in _PLACES:
                raise element.refused(f"<{element.tag} {name}> is {value!r}, a xacro expression; {expand(root.path)}")


def _all(element: Element) -> Iterator[Element]:
    yield element
    for child in element.children:
        yield from _all(child)
