"""Load cases, and combinations of them with their factors."""
