"""Prototype executor."""
import sys

sys.path.insert(0, "/tmp/proto")


def executor_of(grasp, task):
    from eq import Eq
    from prod import executor

    return executor(Eq(grasp), task)
