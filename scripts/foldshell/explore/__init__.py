"""Search of the crease pattern: variables, proposals, evaluations, what was found."""
