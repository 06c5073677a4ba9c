"""Limits, one file each: what must hold at every knot."""
