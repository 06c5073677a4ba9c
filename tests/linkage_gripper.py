"""A gripper of two parallel linkages on one motor, as a URDF and as an MJCF, and a block between its tips."""

from __future__ import annotations

MASS, FRICTION, MARGIN = 0.3, 0.6, 0.5  # kg, 1, N
LEAST_FORCE = (MASS * 9.81 / 2 + MARGIN) / FRICTION
"""[N] At least this much at each of two opposite contacts, with the weight between them."""

URDF = """<robot name="linkage">
  <link name="base"/><link name="l_arm"/><link name="l_tip"/><link name="r_arm"/><link name="r_tip"/>
  <joint name="motor" type="revolute"><parent link="base"/><child link="l_arm"/><origin xyz="0 0.045 0"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.8" effort="10"/></joint>
  <joint name="l_tip" type="revolute"><parent link="l_arm"/><child link="l_tip"/><origin xyz="0 0 0.06"/>
    <axis xyz="1 0 0"/>
    <limit RANGE effort="10"/>
    <mimic joint="motor" multiplier="-1"/></joint>
  <joint name="r_arm" type="revolute"><parent link="base"/><child link="r_arm"/><origin xyz="0 -0.045 0"/>
    <axis xyz="-1 0 0"/><limit lower="0" upper="0.8" effort="10"/><mimic joint="motor"/></joint>
  <joint name="r_tip" type="revolute"><parent link="r_arm"/><child link="r_tip"/><origin xyz="0 0 0.06"/>
    <axis xyz="-1 0 0"/><limit RANGE effort="10"/><mimic joint="motor" multiplier="-1"/></joint>
</robot>"""
RANGE_LINE, MIMIC_LINE = 7, 8
"""Of l_tip in `URDF`."""

MJCF = """<mujoco><compiler angle="radian"/><worldbody><body name="base">
  <body name="l_arm" pos="0 0.045 0"><joint name="motor" axis="1 0 0" range="0 0.8"/><body name="l_tip" pos="0 0 0.06">
    <joint name="l_tip" axis="1 0 0" range="RANGE"/></body></body>
  <body name="r_arm" pos="0 -0.045 0"><joint name="r_arm" axis="-1 0 0" range="0 0.8"/>
    <body name="r_tip" pos="0 0 0.06"><joint name="r_tip" axis="-1 0 0" range="RANGE"/></body></body></body></worldbody>
<equality>
  <joint joint1="l_tip" joint2="motor" polycoef="0 -1 0 0 0"/>
  <joint joint1="r_arm" joint2="motor"/><joint joint1="r_tip" joint2="motor" polycoef="0 -1 0 0 0"/>
</equality></mujoco>"""
MJCF_RANGE_LINE, EQUALITY_LINE = 3, 7
"""Of l_tip in `MJCF`."""

HAND_TOML = """schema = 1
title = "linkage"
model = "hand.urdf"
joint = [{ name = "motor" }, { name = "l_tip" }, { name = "r_arm" }, { name = "r_tip" }]
synergies.motor.columns.motor = { motor = 1 }
postures.zero.joints = { motor = "0 deg" }
"""

PROBLEM = """schema = 1
title = "A linkage gripper closes on a block"
[hand]
model = "MODEL"
posture = "zero"
close = "motor"
compliance = { joint = "0.01 rad/(N m)" }
[object]
shape = { box = { size = ["40 mm", "40 mm", "60 mm"] } }
mass = "300 g"
position = ["0 mm", "OFF mm", "85 mm"]
[contacts]
model = "soft"
friction = 0.6
spin_friction = "5 mm"
stiffness = "20 N/mm"
spin_stiffness = "2 N m/rad"
[[contact]]
link = "l_tip"
point = ["0 mm", "0 mm", "30 mm"]
[[contact]]
link = "r_tip"
point = ["0 mm", "0 mm", "30 mm"]
[task]
gravity = [0, 0, -9.81]
[limits]
margin = "0.5 N"
"""


def urdf(lower: float, upper: float) -> str:
    """Return the URDF whose tips state this range of their own [rad]; their mimic wants 0 to -0.8."""
    return URDF.replace("RANGE", f'lower="{lower}" upper="{upper}"')


def mjcf(lower: float, upper: float) -> str:
    """Return the same as an MJCF."""
    return MJCF.replace("RANGE", f"{lower} {upper}")


def problem(model: str, off: float = 0.0) -> str:
    """Return a problem on the gripper, with the block `off` [mm] its middle."""
    return PROBLEM.replace("MODEL", model).replace("OFF", f"{off:g}")
