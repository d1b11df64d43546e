"""Target surfaces, and sheets folded onto them in four modes; the quality of what came out."""
