"""Shapes of objects, one file a shape: its surface, its inertia, how it is drawn, its sizes in a file."""
