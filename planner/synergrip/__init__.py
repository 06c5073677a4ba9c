"""Grasp forces and in-hand motion for robot hands driven by postural synergies."""

__version__ = "0.1.0"
