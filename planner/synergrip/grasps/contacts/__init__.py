"""Contacts, one file a kind: what it transmits and what it withstands."""
