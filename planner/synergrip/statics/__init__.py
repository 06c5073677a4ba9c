"""What a grasp can do: its response, the controlled subspaces, Theorem 1. Sections II-B to III of the paper."""

from synergrip.statics.response import Response, respond
from synergrip.statics.subspaces import Subspaces, subspaces
from synergrip.statics.theorem1 import Coordinates, coordinates

__all__ = ["Coordinates", "Response", "Subspaces", "coordinates", "respond", "subspaces"]
