"""How heavy, how slippery, how hard, how fast, how far: numbers about a grasp and a task that has a plan."""
