"""What is asked of a grasp: loads, a wanted motion, limits and goals, as values at any time of the task."""
