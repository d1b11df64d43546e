"""Pictures of designs and charts over all of them."""
