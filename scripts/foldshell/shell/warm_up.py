"""Tables of the usual element orders and the solver's library, got ready at import.

The fork server imports this once, so that its jobs find both in memory: 10 ms less an analysis.
"""

from foldshell.shell.cholmod_library import open_library
from foldshell.shell.geometric import geometric_tables
from foldshell.shell.reference import reference_triangle

ORDERS = (5, 7)
"""Of the mesh that the study sizes on (four subdivisions), and of the one that gives its error."""

for order in ORDERS:
    reference_triangle(order)
    geometric_tables(order)
open_library()
