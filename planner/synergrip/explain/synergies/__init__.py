"""Synergies that are missing for a task, and the fewest that it takes."""
