"""Keys of a problem file for the arguments of `make_grasp`: mistakes are told by what stands in the file."""

from __future__ import annotations

from dataclasses import replace

from synergrip.errors import Issue

KEYS = {
    "posture": "hand.posture", "synergies": "hand.synergies", "close": "hand.close",
    "joint_compliance": "hand.compliance.joint", "synergy_compliance": "hand.compliance.synergy",
    "object.shape.radius": "object.shape.sphere.radius",
}  # fmt: skip
"""Argument of `make_grasp` -> key of the problem file."""


def in_file(issue: Issue) -> Issue:
    """Return an issue with the key of the file in the place of the argument; one that has its place keeps it."""
    if issue.file:
        return issue
    for argument, key in KEYS.items():
        rest = issue.key.removeprefix(argument)
        if rest != issue.key and rest[:1] in ("", ".", "["):
            return replace(issue, key=key + rest)
    return issue
