"""Folding sheets onto target surfaces."""
