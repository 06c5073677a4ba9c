"""What an interior-point method needs of a long trajectory: cones side by side, and a banded matrix of its knots."""
