"""Small MJCF files, and MuJoCo as their referee."""

from __future__ import annotations

import re

import mujoco

NEEDED_BY_MUJOCO = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'


def fingers(*joints: tuple[str, str], after: str = "") -> str:
    """Return a palm with a body for each (joint name, its other attributes), and what comes after; in rad."""
    bodies = "".join(f'<body name="{name}"><joint name="{name}" {rest}/></body>' for name, rest in joints)
    return f"""<mujoco><compiler angle="radian"/><worldbody><body name="palm">{bodies}</body></worldbody>
{after}</mujoco>"""


def plain(*names: str, after: str = "") -> str:
    """Return a palm with a hinge of each name."""
    return fingers(*((name, 'axis="0 0 1"') for name in names), after=after)


def with_masses(text: str) -> mujoco.MjModel:
    """Return the whole file as MuJoCo reads it, once every body has a mass."""
    return mujoco.MjModel.from_xml_string(re.sub(r"<body\b[^>]*>", rf"\g<0>{NEEDED_BY_MUJOCO}", text))
