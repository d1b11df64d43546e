"""Meshes from files: one reader for all formats, strict about what would be misread."""
