"""Random formulations of a few knots, and one limit of each kind around what they are like."""

from __future__ import annotations

import numpy as np
from random_grasps import random_grasp

import synergrip as sg
from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation, Units
from synergrip.linalg import frozen
from synergrip.statics.analysis import analyse

KNOTS = 4
LIMITS = {
    "friction": lambda g: sg.SlipMargin(0.7),
    "friction reserve": lambda g: sg.FrictionReserve(ratios=frozen(np.linspace(0.5, 0.9, g.n_c))),
    "friction angle": lambda g: sg.FrictionReserve(angle=0.05),
    "friction factor": lambda g: sg.FrictionReserve(factor=1.3),
    "friction factor, less a share": lambda g: sg.FrictionReserve(factor=1.3).loosened(0.1),
    "normal": lambda g: sg.NormalForce(0.5, 3.0),
    "normal, no upper": lambda g: sg.NormalForce(0.5, np.inf),
    "torque": lambda g: sg.JointTorque(frozen(np.linspace(0.05, 0.3, g.n_q))),
    "torque, some free": lambda g: sg.JointTorque(frozen([np.inf, np.inf, 0.1, *[np.inf] * (g.n_q - 3)])),
    "effort": lambda g: sg.ActuatorEffort(frozen(np.linspace(0.1, 0.6, g.n_z))),
    "sustained torque": lambda g: sg.SustainedTorque(frozen(np.linspace(0.05, 0.3, g.n_q))),
    "sustained torque, some free": lambda g: sg.SustainedTorque(
        frozen([np.inf, np.inf, 0.05, *[np.inf] * (g.n_q - 3)])
    ),
    "sustained effort": lambda g: sg.SustainedEffort(frozen(np.linspace(0.1, 0.6, g.n_z))),
    "reference": lambda g: sg.SynergyReference(frozen(np.linspace(0.01, 0.05, g.n_z))),
    "rate": lambda g: sg.SynergyRate(frozen(np.linspace(0.02, 0.1, g.n_z))),
    "rate, some free": lambda g: sg.SynergyRate(frozen([0.05, *[np.inf] * (g.n_z - 1)])),
    "acceleration": lambda g: sg.SynergyAcceleration(frozen(np.linspace(0.02, 0.1, g.n_z))),
    "acceleration, some free": lambda g: sg.SynergyAcceleration(frozen([0.05, *[np.inf] * (g.n_z - 1)])),
    "joint range": lambda g: _range(g.n_q, np.linspace(0.02, 0.1, g.n_q)),
    "joint range, some free": lambda g: _range(g.n_q, np.r_[0.02, np.full(g.n_q - 1, np.inf)]),
    "elastic motion": lambda g: sg.ElasticMotion(1e-3),
    "drift": lambda g: sg.ObjectError(2e-3),
    "drift of the rigid part on some axes": lambda g: sg.ObjectError(2e-3, ("x", "rz"), "rigid"),
}


def _range(n: int, half: np.ndarray) -> sg.JointRange:
    return sg.JointRange(frozen(np.full(n, 0.4)), frozen(0.4 - half), frozen(0.4 + half))


def random_formulation(seed: int, redundancy: bool = True) -> tuple[np.random.Generator, Formulation]:
    rng = np.random.default_rng(seed)
    kinds = [["hard", "soft", "hard"], ["frictionless", "hard", "soft", "hard"]][seed % 2]
    analysis = analyse(random_grasp(rng, kinds, degenerate=seed % 3 == 0))
    times = np.array([0.0, 0.3, 0.5, 1.1])
    wrench = rng.normal(size=(KNOTS, 6)) * [1, 1, 1, 0.02, 0.02, 0.02]
    beta = 1e-3 * rng.normal(size=(KNOTS, analysis.spaces.Gamma_ucs.shape[1]))
    formulation = formulate(analysis.response, analysis.spaces, analysis.coordinates, times=times, wrench=wrench,
                        beta=beta, units=Units(1.7, 0.3, 0.01), redundancy=redundancy,
                        beta_basis=np.eye(beta.shape[1])[:, : max(beta.shape[1] - seed // 3, 1)],
                        target=1e-3 * rng.normal(size=(KNOTS, 6)))  # fmt: skip
    return rng, formulation
