"""From a URDF or an MJCF file to a `LinkTree`; its outermost element says which it is, whatever its name."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from synergrip.errors import one_of
from synergrip.hands.tree import LinkTree
from synergrip.hands.urdf import urdf_tree
from synergrip.hands.xml_elements import read_xml

SUFFIXES = (".urdf", ".xml")


def read_model(path: Path, key: str = "", told: Collection[str] = (), palm: str = "") -> LinkTree:
    """Return the links of the file at `path`, <robot> (URDF) or <mujoco> (MJCF).

    Args:
        path: the file.
        key: the key of another file that names this one, for a file that is missing.
        told: joints whose <mimic> in a URDF is passed over, because another file says what they follow.
        palm: the link that is the palm, when it is not the outermost one.

    Raises:
        InputError: what `read_xml`, `urdf_tree` or `mjcf_tree` refuse, or another kind of XML file; a link that is not
            there, at the key ``palm``.
    """
    root = read_xml(path, "URDF or MJCF file", key)
    if root.tag == "robot":
        return urdf_tree(root, told, palm)
    if root.tag == "mujoco":
        from synergrip.hands.mjcf_tree import mjcf_tree

        return mjcf_tree(root, palm)
    raise root.refused(f"a hand is a <robot> (URDF) or a <mujoco> (MJCF); {one_of(root.tag, ('robot', 'mujoco'))}")
