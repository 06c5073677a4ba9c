"""The second formulation, written in CVXPY independently of the program's rows: the referee."""
