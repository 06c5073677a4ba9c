"""Grasp forces and in-hand motion for robot hands driven by postural synergies.

The public names, in the order of the pipeline; each is loaded when it is first used.
"""

from __future__ import annotations

TYPE_CHECKING = False  # that of typing, which the command line has no time to import before it hears Ctrl-C
if TYPE_CHECKING:
    from typing import Any

    from synergrip.conic.certificate import Certificate as Certificate
    from synergrip.conic.program import Program as Program
    from synergrip.errors import InputError as InputError
    from synergrip.errors import Refusal as Refusal
    from synergrip.errors import SynergripError as SynergripError
    from synergrip.grasps.contacts.contact import Contact as Contact
    from synergrip.grasps.grasp import Grasp as Grasp
    from synergrip.grasps.matrices import read_matrices as read_matrices
    from synergrip.grasps.stack import GraspStack as GraspStack
    from synergrip.hands.folder import load_hand as load_hand
    from synergrip.hands.hand import Hand as Hand
    from synergrip.planning.outcome import Infeasible as Infeasible
    from synergrip.planning.outcome import Plan as Plan
    from synergrip.planning.outcome import Unknown as Unknown
    from synergrip.planning.planning import plan as plan
    from synergrip.problems.problem import Problem as Problem
    from synergrip.problems.problem import load_problem as load_problem
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
    from synergrip.tasks.timed_task import TimedTask as TimedTask

__version__ = "0.1.0"

_HOMES = {
    "errors": ("SynergripError", "InputError", "Refusal"),
    "hands.hand": ("Hand",),
    "hands.folder": ("load_hand",),
    "grasps.contacts.contact": ("Contact",),
    "grasps.grasp": ("Grasp",),
    "grasps.matrices": ("read_matrices",),
    "grasps.stack": ("GraspStack",),
    "statics": ("respond", "subspaces", "coordinates"),
    "conic.program": ("Program",),
    "conic.certificate": ("Certificate",),
    "statics.analysis": ("Analysis", "analyse"),
    "statics.responses": ("respond_many",),
    "statics.subspace_groups": ("subspaces_many", "coordinates_many"),
    "statics.analyses": ("Analyses", "analyse_many"),
    "tasks.timed_task": ("TimedTask",),
    "problems.problem": ("Problem", "load_problem"),
    "planning.outcome": ("Plan", "Infeasible", "Unknown"),
    "planning.planning": ("plan",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME_OF]


def __getattr__(name: str) -> Any:
    """Import a public name from its home on first use."""
    if name not in _HOME_OF:
        raise AttributeError(f"module 'synergrip' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"synergrip.{_HOME_OF[name]}"), name)
