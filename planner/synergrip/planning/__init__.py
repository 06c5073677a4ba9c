"""What is answered: the problem, the task at its knots, the plan and its check."""
