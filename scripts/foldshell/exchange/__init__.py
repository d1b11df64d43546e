"""Files for other programs: VTU, and the neutral model of the cross-check."""
