"""Solvers, one file each: program -> solution, nothing else."""
