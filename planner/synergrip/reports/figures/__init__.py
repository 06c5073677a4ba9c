"""Pictures for papers: what there is to draw, from what, and on which paper."""
