"""Many small problems at once: a batched interior-point method, and plans of one knot for thousands of tasks."""
