"""Folded shell structures: pattern, folding, shell analysis, sizing, and their files."""
