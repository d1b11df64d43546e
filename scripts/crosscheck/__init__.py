"""An independent finite-element check of a folded shell.

It shares no line with the library beside it: it reads a neutral model file, meshes the facets
with nine-node quadrilaterals, puts on the loads of the paper, assembles and solves with numpy
and scipy, and compares its own values with those another program wrote down.
Units: m, kN, kPa, rad.
"""

import os

# The fronts are small: a second BLAS thread costs four times the time. Set before numpy loads.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Huge pages are cleared whole, for arrays that live for milliseconds: it is 8 % of the time.
os.environ.setdefault("NUMPY_MADVISE_HUGEPAGE", "0")
