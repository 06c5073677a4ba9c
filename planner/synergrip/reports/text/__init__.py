"""Answers as text, for terminals."""
