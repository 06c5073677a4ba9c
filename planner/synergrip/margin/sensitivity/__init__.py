"""How much margins change with each number of a grasp and a task."""
