"""What a plan withstands beside its load."""
