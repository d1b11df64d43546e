"""Reinforced concrete by EN 1992-1-1:2004: steel, struts, shear, cracks, and whether bars fit."""
