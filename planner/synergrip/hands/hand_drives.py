"""What a hand.toml leaves of what its model file says of motors and springs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from synergrip.hands.drives import Drives
from synergrip.hands.hand import Coupling
from synergrip.hands.hand_file import HandFile
from synergrip.hands.models.tree import LinkTree
from synergrip.linalg import frozen


def told_drives(tree: LinkTree, couplings: Mapping[str, Coupling], file: HandFile) -> Drives | None:
    """Return notes where a hand.toml is silent on joints that no motor of the model file drives; it has the last word.

    What springs take of motors stays as the model file has it: a hand.toml says nothing of that.

    Args:
        tree: what the model file says.
        couplings: what follows what, by both files.
        file: the hand.toml.
    """
    if tree.drives is None:
        return None
    none = frozen(np.zeros((len(tree.moving), len(tree.moving))))
    order = [tree.moving.index(table.name) for table in file.joint]
    K, b = tree.drives.stiffness, tree.drives.pulled
    return Drives(
        none,
        notes=tuple(_notes(tree.drives, couplings, file)),
        stiffness=None if K is None else frozen(K[np.ix_(order, order)]),
        pulled=None if b is None else frozen(b[order]),
    )


def _notes(drives: Drives, couplings: Mapping[str, Coupling], file: HandFile) -> Iterator[str]:
    idle = [name for name in drives.idle if name not in couplings]
    if idle and not file.synergies:
        yield (
            f"no actuator of {file.model} is known to drive {_listed(idle)}, and hand.toml has no [synergies]: in the "
            "set 'joints' each of them moves by itself"
        )
    rigid = [table.name for table in file.joint if table.name in drives.sprung and table.compliance is None]
    if rigid:
        yield (
            f"in {file.model} only springs hold {_listed(rigid)}, and hand.toml gives no compliance: they are taken as "
            "rigid"
        )


def _listed(names: list[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
