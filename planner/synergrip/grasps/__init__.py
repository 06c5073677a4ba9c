"""Where the hand touches the object: contact kinds, objects, G and J."""
