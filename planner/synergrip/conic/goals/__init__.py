"""Goals, one file each: what is best among the plans that hold."""
