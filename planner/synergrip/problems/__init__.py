"""From a problem file to a grasp and a task: what may stand in it, and what its tables mean."""
