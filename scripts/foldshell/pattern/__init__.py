"""Crease patterns: geometry, topology, folding path, files."""
