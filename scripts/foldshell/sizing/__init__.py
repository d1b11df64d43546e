"""The thickness loop: criteria, rules, gradients, classes."""
