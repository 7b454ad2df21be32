"""For every worker of a test run; read before any of them imports NumPy."""

import os

# The runner already keeps each core busy: BLAS threads that wait for a core make small matrices ten times slower.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
