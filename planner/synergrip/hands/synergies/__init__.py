"""Synergies: matrices and their files, recorded postures and their principal components."""
