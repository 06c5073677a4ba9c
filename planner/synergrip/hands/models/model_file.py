"""From a URDF or an MJCF file to a `LinkTree`; its outermost element says which it is, whatever its name."""

from __future__ import annotations

from collections.abc import Collection
from os.path import isfile  # unlike Path.is_file, no error for a name that is too long
from pathlib import Path

from synergrip.errors import InputError, Issue, one_of
from synergrip.hands.models.foreign_files import ROOTS, refuse_macros, said_by_name
from synergrip.hands.models.tree import LinkTree
from synergrip.hands.models.urdf import urdf_tree
from synergrip.hands.models.xml_elements import read_xml

SUFFIXES = (".urdf", ".xml", ".mjcf")
"""What the names of model files end in, in lower case."""


def read_model(path: Path, key: str = "", told: Collection[str] = (), palm: str = "") -> LinkTree:
    """Return the links of the file at `path`, <robot> (URDF) or <mujoco> (MJCF).

    Args:
        path: the file.
        key: the key of another file that names this one, for a file that is missing.
        told: joints whose <mimic> in a URDF is passed over, because another file says what they follow.
        palm: the link that is the palm, when it is not the outermost one.

    Raises:
        InputError: what `read_xml`, `urdf_tree` or `mjcf_tree` refuse, xacro macros, or another kind of file; a palm
            that is not there, at the key ``palm``.
    """
    if said := said_by_name(path) if isfile(path) else "":
        raise InputError.at(key, said) if key else InputError([Issue(said, file=str(path))])
    root = read_xml(path, "URDF or MJCF file", key)
    if root.tag == "robot":
        return urdf_tree(root, told, palm)
    if root.tag == "mujoco":
        from synergrip.hands.models.mjcf_tree import mjcf_tree

        refuse_macros(root)
        return mjcf_tree(root, palm)
    hint = f"; {ROOTS[root.tag]}" if root.tag in ROOTS else ""
    wrong = one_of(root.tag, ("robot", "mujoco"))
    raise root.refused(f"a hand is a <robot> (URDF) or a <mujoco> (MJCF); {wrong}{hint}")
