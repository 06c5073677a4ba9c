"""Pictures of hands, synergies and grasps, as SVG, PNG or PDF."""
