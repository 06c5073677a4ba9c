"""Answers as JSON, CSV and NPZ, for programs."""
