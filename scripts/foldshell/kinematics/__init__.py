"""What a Miura sheet can do by itself: mechanisms, Poisson's ratios, the paper's geometric rules."""
