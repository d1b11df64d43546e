"""Crease patterns: geometry, topology, folding path, unfolding, FOLD files and drawings."""
