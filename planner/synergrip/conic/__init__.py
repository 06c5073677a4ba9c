"""What is asked, as a second-order cone program; its solvers; its certificates."""
