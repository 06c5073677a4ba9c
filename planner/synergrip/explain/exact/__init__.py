"""A no proven again in fractions."""
