"""Grasp forces and in-hand motion for robot hands driven by postural synergies.

The public names, in the order of the pipeline; each is loaded when it is first used.
"""

from __future__ import annotations

TYPE_CHECKING = False  # that of typing, which the command line has no time to import before it hears Ctrl-C
if TYPE_CHECKING:
    from typing import Any

    from synergrip.conic.certificate import Certificate as Certificate
    from synergrip.conic.goals.centred_joints import CentredJoints as CentredJoints
    from synergrip.conic.goals.goal import Goal as Goal
    from synergrip.conic.goals.goal import Objective as Objective
    from synergrip.conic.goals.goal import squares_of as squares_of
    from synergrip.conic.goals.largest_margin import LargestMargin as LargestMargin
    from synergrip.conic.goals.least_effort import LeastEffort as LeastEffort
    from synergrip.conic.goals.least_motion import LeastMotion as LeastMotion
    from synergrip.conic.goals.least_peak import LeastPeak as LeastPeak
    from synergrip.conic.goals.steady_forces import SteadyForces as SteadyForces
    from synergrip.conic.goals.weighted_sum import WeightedSum as WeightedSum
    from synergrip.conic.limits.actuator_effort import ActuatorEffort as ActuatorEffort
    from synergrip.conic.limits.elastic_motion import ElasticMotion as ElasticMotion
    from synergrip.conic.limits.friction_reserve import FrictionReserve as FrictionReserve
    from synergrip.conic.limits.joint_range import JointRange as JointRange
    from synergrip.conic.limits.joint_torque import JointTorque as JointTorque
    from synergrip.conic.limits.limit import Limit as Limit
    from synergrip.conic.limits.limit import Usage as Usage
    from synergrip.conic.limits.normal_force import NormalForce as NormalForce
    from synergrip.conic.limits.object_error import ObjectError as ObjectError
    from synergrip.conic.limits.slip_margin import SlipMargin as SlipMargin
    from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration as SynergyAcceleration
    from synergrip.conic.limits.synergy_rate import SynergyRate as SynergyRate
    from synergrip.conic.limits.synergy_reference import SynergyReference as SynergyReference
    from synergrip.conic.program import Program as Program
    from synergrip.conic.rows import norm_within as norm_within
    from synergrip.conic.rows import within as within
    from synergrip.equilibrium.execution import Execution as Execution
    from synergrip.equilibrium.execution import execute as execute
    from synergrip.equilibrium.states import Loads as Loads
    from synergrip.errors import InputError as InputError
    from synergrip.errors import OutputError as OutputError
    from synergrip.errors import Refusal as Refusal
    from synergrip.errors import SelfCheckError as SelfCheckError
    from synergrip.errors import SynergripError as SynergripError
    from synergrip.errors import VerdictError as VerdictError
    from synergrip.grasps.contact_at import ContactAt as ContactAt
    from synergrip.grasps.contact_at import LinkPlace as LinkPlace
    from synergrip.grasps.contacts.contact import Contact as Contact
    from synergrip.grasps.contacts.elliptic_soft_finger import EllipticSoftFinger as EllipticSoftFinger
    from synergrip.grasps.contacts.frictionless import Frictionless as Frictionless
    from synergrip.grasps.contacts.hard_finger import HardFinger as HardFinger
    from synergrip.grasps.contacts.kind import ContactKind as ContactKind
    from synergrip.grasps.contacts.patch_contact import PatchContact as PatchContact
    from synergrip.grasps.contacts.soft_finger import SoftFinger as SoftFinger
    from synergrip.grasps.from_matrices import grasp_from_matrices as grasp_from_matrices
    from synergrip.grasps.grasp import Grasp as Grasp
    from synergrip.grasps.making import make_grasp as make_grasp
    from synergrip.grasps.matrices import GivenContact as GivenContact
    from synergrip.grasps.matrices import read_matrices as read_matrices
    from synergrip.grasps.objects import Object as Object
    from synergrip.grasps.objects import Turned as Turned
    from synergrip.grasps.shapes.box import Box as Box
    from synergrip.grasps.shapes.cylinder import Cylinder as Cylinder
    from synergrip.grasps.shapes.shape import Shape as Shape
    from synergrip.grasps.shapes.sphere import Sphere as Sphere
    from synergrip.grasps.stack import GraspStack as GraspStack
    from synergrip.hands.folder import load_hand as load_hand
    from synergrip.hands.hand import Hand as Hand
    from synergrip.planning.outcome import Infeasible as Infeasible
    from synergrip.planning.outcome import Plan as Plan
    from synergrip.planning.outcome import Unknown as Unknown
    from synergrip.planning.planning import plan as plan
    from synergrip.problems.problem import Problem as Problem
    from synergrip.problems.problem import load_problem as load_problem
    from synergrip.simulation.simulation import Simulation as Simulation
    from synergrip.simulation.simulation import simulate as simulate
    from synergrip.statics import coordinates as coordinates
    from synergrip.statics import respond as respond
    from synergrip.statics import subspaces as subspaces
    from synergrip.statics.analyses import Analyses as Analyses
    from synergrip.statics.analyses import analyse_many as analyse_many
    from synergrip.statics.analysis import Analysis as Analysis
    from synergrip.statics.analysis import analyse as analyse
    from synergrip.statics.responses import respond_many as respond_many
    from synergrip.statics.subspace_groups import coordinates_many as coordinates_many
    from synergrip.statics.subspace_groups import subspaces_many as subspaces_many
    from synergrip.tasks.gravity import Gravity as Gravity
    from synergrip.tasks.hold import Hold as Hold
    from synergrip.tasks.motion_tables import ModesTable as ModesTable
    from synergrip.tasks.motion_tables import MotionTable as MotionTable
    from synergrip.tasks.moves import ModeMove as ModeMove
    from synergrip.tasks.moves import Move as Move
    from synergrip.tasks.palm_motion import Palm as Palm
    from synergrip.tasks.palm_path import PalmPath as PalmPath
    from synergrip.tasks.pushes import Push as Push
    from synergrip.tasks.task import Task as Task
    from synergrip.tasks.timed_task import TimedTask as TimedTask
    from synergrip.tasks.waypoints import Waypoints as Waypoints
    from synergrip.tasks.wrenches import Wrench as Wrench
    from synergrip.tasks.wrenches import WrenchTable as WrenchTable

__version__ = "0.1.0"

_HOMES = {
    "errors": ("SynergripError", "InputError", "VerdictError", "Refusal", "SelfCheckError", "OutputError"),
    "hands.folder": ("load_hand",),
    "hands.hand": ("Hand",),
    "grasps.objects": ("Object", "Turned"),
    "grasps.shapes.shape": ("Shape",),
    "grasps.shapes.sphere": ("Sphere",),
    "grasps.shapes.box": ("Box",),
    "grasps.shapes.cylinder": ("Cylinder",),
    "grasps.contacts.kind": ("ContactKind",),
    "grasps.contacts.hard_finger": ("HardFinger",),
    "grasps.contacts.soft_finger": ("SoftFinger",),
    "grasps.contacts.elliptic_soft_finger": ("EllipticSoftFinger",),
    "grasps.contacts.patch_contact": ("PatchContact",),
    "grasps.contacts.frictionless": ("Frictionless",),
    "grasps.contacts.contact": ("Contact",),
    "grasps.contact_at": ("ContactAt", "LinkPlace"),
    "grasps.grasp": ("Grasp",),
    "grasps.making": ("make_grasp",),
    "grasps.from_matrices": ("grasp_from_matrices",),
    "grasps.matrices": ("GivenContact", "read_matrices"),
    "statics.analysis": ("analyse", "Analysis"),
    "grasps.stack": ("GraspStack",),
    "statics.analyses": ("analyse_many", "Analyses"),
    "statics": ("respond", "subspaces", "coordinates"),
    "statics.responses": ("respond_many",),
    "statics.subspace_groups": ("subspaces_many", "coordinates_many"),
    "equilibrium.execution": ("execute", "Execution"),
    "equilibrium.states": ("Loads",),
    "conic.limits.limit": ("Limit", "Usage"),
    "conic.limits.slip_margin": ("SlipMargin",),
    "conic.limits.friction_reserve": ("FrictionReserve",),
    "conic.limits.normal_force": ("NormalForce",),
    "conic.limits.joint_torque": ("JointTorque",),
    "conic.limits.actuator_effort": ("ActuatorEffort",),
    "conic.limits.joint_range": ("JointRange",),
    "conic.limits.synergy_reference": ("SynergyReference",),
    "conic.limits.synergy_rate": ("SynergyRate",),
    "conic.limits.synergy_acceleration": ("SynergyAcceleration",),
    "conic.limits.elastic_motion": ("ElasticMotion",),
    "conic.limits.object_error": ("ObjectError",),
    "conic.rows": ("within", "norm_within"),
    "conic.goals.goal": ("Goal", "Objective", "squares_of"),
    "conic.goals.largest_margin": ("LargestMargin",),
    "conic.goals.least_peak": ("LeastPeak",),
    "conic.goals.least_effort": ("LeastEffort",),
    "conic.goals.steady_forces": ("SteadyForces",),
    "conic.goals.least_motion": ("LeastMotion",),
    "conic.goals.centred_joints": ("CentredJoints",),
    "conic.goals.weighted_sum": ("WeightedSum",),
    "conic.program": ("Program",),
    "conic.certificate": ("Certificate",),
    "tasks.hold": ("Hold",),
    "tasks.moves": ("Move", "ModeMove"),
    "tasks.waypoints": ("Waypoints",),
    "tasks.motion_tables": ("MotionTable", "ModesTable"),
    "tasks.gravity": ("Gravity",),
    "tasks.wrenches": ("Wrench", "WrenchTable"),
    "tasks.pushes": ("Push",),
    "tasks.palm_motion": ("Palm",),
    "tasks.palm_path": ("PalmPath",),
    "tasks.task": ("Task",),
    "tasks.timed_task": ("TimedTask",),
    "problems.problem": ("load_problem", "Problem"),
    "planning.planning": ("plan",),
    "planning.outcome": ("Plan", "Infeasible", "Unknown"),
    "simulation.simulation": ("simulate", "Simulation"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME_OF]


def __getattr__(name: str) -> Any:
    """Import a public name from its home on first use."""
    if name not in _HOME_OF:
        raise AttributeError(f"module 'synergrip' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"synergrip.{_HOME_OF[name]}"), name)


def __dir__() -> list[str]:
    """Return the public names, loaded or not."""
    return list(__all__)
