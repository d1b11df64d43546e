"""The shell element, assembly, solvers, buckling and second order, supports, edge beams."""
