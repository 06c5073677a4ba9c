"""The fastest way along a given path of the palm: its timing is free, its shape is kept."""
