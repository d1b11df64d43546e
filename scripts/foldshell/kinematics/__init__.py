"""What a Miura sheet can do: mechanisms, Poisson's ratios, the paper's geometric rules."""
