"""Hand files of others, URDF and MJCF, read into a tree of links."""
