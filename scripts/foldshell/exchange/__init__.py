"""Files for other programs in some fourteen formats, and the neutral model of the cross-check."""
