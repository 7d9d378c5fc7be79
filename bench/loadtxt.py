"""How fast does NumPy's loadtxt read a file like that of bench-read, but of 20 MB? Prints MB of the file per second. loadtxt keeps all rows
in memory."""

import math
import tempfile
import time

import numpy

with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
    k = size = 0
    while size < 20e6:
        force = [400 * math.sin(0.06 * k + 0.4 * c) for c in range(16)]
        size += file.write(f"{k * 0.01:.2f}," + ",".join(f"{F:.2f}" if F > 0 else "0" for F in force) + "\n")
        k += 1
    file.flush()
    start = time.perf_counter()
    rows = len(numpy.loadtxt(file.name, delimiter=","))
    seconds = time.perf_counter() - start
    print(f"numpy {numpy.__version__} loadtxt, 20 MB {size / seconds / 1e6:27.0f} MB/s {seconds:6.2f} s {rows:12} rows")
