"""Tasks of one knot on one grasp, or on grasps of like dimensions, stacked: problem k is knot k of one formulation.

Limits and goals write their rows for all knots at once, with one matrix for all or one for each; what they write
for the knots of a trajectory they so write for many tasks that know nothing of each other.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from operator import attrgetter

import numpy as np

from synergrip.conic.affine import times
from synergrip.conic.departure import Departure
from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation, Units
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.normal_force import least_normal_force
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Metric
from synergrip.grasps.stack import GraspStack
from synergrip.grasps.stacked_kinds import StackedKinds
from synergrip.linalg import Array, frozen, sealed
from synergrip.statics.analyses import AnalysisGroup
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each, EachGrasp, EachResponse
from synergrip.statics.subspaces import Bases
from synergrip.tasks.scaling import smallest_cap
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Stated(Value):
    """N tasks of one knot, in newtons: what differs is load, friction and, of many grasps, everything of the grasp."""

    task: TimedTask
    """What they have in common."""
    formulation: Formulation
    """Knot k is problem k; its unknowns are internal forces in newtons and redundancy in units of the references."""
    friction: Array | None
    """(N,) by which friction is multiplied; None for the contacts as they are."""
    grasps: tuple[Grasp, ...]
    """One for all, or N."""
    kinds: StackedKinds
    """Of the contacts of these."""
    metric: Metric
    """Scaled coordinates of the one grasp, or (N, ...) of each."""
    postures: Array | None
    """(1, n_q) joint values of the hand at the start, or (N, n_q) of each; None for grasps given as matrices."""

    @property
    def count(self) -> int:
        """N."""
        return self.formulation.knots

    @property
    def n_alpha(self) -> int:
        """Unknowns that are internal forces; the others are redundancy."""
        return int(self.formulation.alpha.matrix.shape[0])

    @property
    def unit(self) -> Array:
        """(N,) [N] what each task asks of its contacts: forces are measured against it, as in a plan of one task."""
        load = np.abs(self.at_rest * self.metric.force).max(axis=-1)
        unit = np.maximum(load, max(self.task.margin, least_normal_force(self.task.limits)))
        if np.all(unit > 0):
            return np.asarray(unit)
        formulation = self.formulation
        one = Analysis(self.grasps[0], formulation.response, formulation.spaces, formulation.coordinates)
        return np.where(unit > 0, unit, smallest_cap(one, self.task))

    def begins(self, ranges: JointRange) -> Array:
        """Return joint values (1, n_q), or (N, n_q), from which joints move within their ranges."""
        if self.postures is not None and ranges.start is None:
            return self.postures
        return np.asarray(ranges.on(self.grasps[0]).start[None])

    @property
    def at_rest(self) -> Array:
        """(N, n_l) contact forces without references: what the load causes by itself [N, N m]."""
        return self.formulation.force.constant


def stated_on(analysis: Analysis, task: TimedTask, wrench: Array, friction: Array | None) -> Stated:
    """Return the tasks with loads (N, 6) and friction factors (N,) on one grasp."""
    found = _formulated(analysis, task, wrench)
    held, scale = analysis.grasp.held, analysis.response.scale
    postures, kinds = None if held is None else held.q[None], StackedKinds.of((analysis.grasp,))
    return Stated(task, _held_at_start(found, wrench), friction, (analysis.grasp,), kinds, scale, postures)


def stated_each(
    like: Analysis, each: Each, stack: GraspStack, task: TimedTask, wrench: Array, friction: Array | None
) -> Stated:
    """Return the tasks with loads (N, 6) and friction factors (N,) on N grasps, each on its own.

    Args:
        like: of a grasp whose subspaces have the dimensions of all.
        each: the statics of the N.
        stack: the N.
        task: what the tasks have in common.
        wrench: (N, 6) [N, N m].
        friction: (N,) factors; None for friction as it is.
    """
    grasps = stack.given or (stack.like,)
    found = replace(_formulated(like, task, wrench), each=_begun(each, grasps))
    return Stated(task, _held_at_start(found, wrench), friction, grasps, stack.kinds, each.metric, stack.starts)


def _formulated(analysis: Analysis, task: TimedTask, wrench: Array) -> Formulation:
    N, held = len(wrench), np.zeros((len(wrench), analysis.spaces.dimensions[1]))
    finite = [limit.limit[np.isfinite(limit.limit)] for limit in task.limits if isinstance(limit, SynergyReference)]
    reference = max((float(each.max()) for each in finite if each.size), default=1.0)
    return formulate(
        analysis.response, analysis.spaces, analysis.coordinates, times=np.arange(N, dtype=float), wrench=wrench,
        beta=held, units=Units(1.0, reference), redundancy=task.watches_references,
    )  # fmt: skip


def _held_at_start(formulation: Formulation, wrench: Array) -> Formulation:
    """Return it with the load held when the task begins, where that is a hand's: it displaces nothing any more."""
    grasp = formulation.response.grasp
    if grasp.held is None:
        return formulation
    N = len(wrench)
    force = times(formulation.map_of(lambda at: at.response.dlambda_dw), wrench)
    torque = times(formulation.map_of(lambda at: at.response.grasp.J.mT), force)
    begun = Departure(frozen(force), frozen(torque), frozen(np.zeros((N, grasp.n_q))), frozen(np.zeros((N, 6))))
    without = replace(formulation, wrench=frozen(np.broadcast_to(grasp.w_0, (N, 6))), departure=begun)
    if formulation.each is not None:
        return without
    at_start = replace(formulation.response, grasp=replace(grasp, w_0=frozen(np.zeros(6))))
    return replace(without, response=at_start, wrench=frozen(np.zeros((N, 6))))


def each_of(group: AnalysisGroup) -> Each:
    """Return the statics of a group as those at the knots of a motion."""
    matrices, w_0 = group.response.grasps.matrices, group.response.grasps.w_0
    nothing = np.zeros((len(w_0), matrices.G.shape[-1]))
    grasp = EachGrasp(matrices.G, matrices.J, matrices.S, frozen(nothing), frozen(w_0))
    bases = Bases(**{each.name: getattr(group.spaces, each.name) for each in fields(Bases)})
    return Each(EachResponse.of(group.response, grasp), bases, group.coordinates, group.response.grasps.metric)


def _begun(each: Each, grasps: tuple[Grasp, ...]) -> Each:
    """Return statics with what the contacts carry at the start; what hands hold then is told apart."""
    w_0 = each.grasp.w_0
    if grasps[0].held is not None:
        w_0, forces = np.broadcast_to(grasps[0].w_0, w_0.shape), np.zeros((len(each), grasps[0].n_l))
    else:
        forces = times(each.response.dlambda_dw, w_0)
        given = list(map(attrgetter("lambda_0"), grasps)) if len(grasps) > 1 else [grasps[0].lambda_0] * len(each)
        for place in [place for place, known in enumerate(given) if known is not None]:
            forces[place] = given[place]
    grasp = replace(each.grasp, lambda_0=sealed(forces), w_0=frozen(w_0))
    return replace(each, response=replace(each.response, grasp=grasp))


def lengths(metric: Metric) -> Array:
    """Return the characteristic length of a grasp, or (N,) of each [m]."""
    return metric.motion_sizes[..., 3]
