"""Form factors of an obstructed room: steradian against pyViewFactor, on the same facets and the same machine.

    python3 enclosure.py STERADIAN [N ...]        (N: cuts a metre, 72 N^2 facets; 1 and 3 by default)

needs numpy, pyvista and pyviewfactor. Processor time is compared, of all threads, as wall time depends on what else runs. Errors are
those of A_i F_ij, relative to their root mean square, against steradian's matrix at another seed and a tolerance of 0.1 %
(up to 100 facets) or 1 %, whose own error is printed beside.
pyViewFactor judges each pair as seen or hidden as a whole; steradian is run at the loosest tolerance that is at least as
precise, and at 1 %."""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pyvista as pv
import pyviewfactor as pvf

import room

TOLERANCES = ["50%", "20%", "5%", "1%"]


def mesh(squares):
    points = np.array(squares, float).reshape(-1, 3)
    corners = np.arange(len(points)).reshape(-1, 4)
    return pv.PolyData(points, faces=np.insert(corners, 0, 4, axis=1).ravel())


def seconds(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def steradian(program, obj, tolerance, folder, seed=0):
    """The dense matrix, its standard errors, areas and the processor time."""
    out = os.path.join(folder, "matrix.npz")
    before = seconds(resource.RUSAGE_CHILDREN)
    arguments = [program, "form-factor", obj, "--rel-error", tolerance, "--seed", str(seed), "-o", out]
    done = subprocess.run(arguments, capture_output=True, text=True)
    taken = seconds(resource.RUSAGE_CHILDREN) - before
    if done.returncode > 1:
        sys.exit(done.stderr)
    arrays = np.load(out)
    n = len(arrays["areas"])
    dense, error = np.zeros((n, n)), np.zeros((n, n))
    rows = np.repeat(np.arange(n), np.diff(arrays["indptr"]))
    dense[rows, arrays["indices"]] = arrays["data"]
    error[rows, arrays["indices"]] = arrays["std_error"]
    sums = (arrays["sums"] - 1, arrays["sum_std_error"])
    return dense, error, arrays["areas"], taken, sums


def peer(n):
    """pyViewFactor's matrix, F[i, j] from i to j, and the processor time of its second call; the first compiles."""
    whole = mesh(list(room.squares(n)))
    box = mesh([square for square in room.cuboid((1.3, 0.9, 0.7), (1, 1, 1), n, False)])
    small = mesh(list(room.squares(1)))
    pvf.compute_viewfactor_matrix(small, obstacles=[box])
    before, begin = seconds(resource.RUSAGE_SELF), time.perf_counter()
    matrix = pvf.compute_viewfactor_matrix(whole, obstacles=[box]).T
    return matrix, seconds(resource.RUSAGE_SELF) - before, time.perf_counter() - begin


def compare(program, n):
    with tempfile.TemporaryDirectory() as folder:
        obj = os.path.join(folder, "room.obj")
        script = Path(room.__file__)
        Path(obj).write_text(subprocess.run([sys.executable, script, str(n)], capture_output=True, text=True).stdout)
        tolerance = "0.1%" if n == 1 else "1%"
        truth, error, areas, taken, _ = steradian(program, obj, tolerance, folder, seed=1)
        exchange = areas[:, None] * truth
        scale = np.sqrt(np.mean(exchange**2))
        rms = lambda matrix: np.sqrt(np.mean((areas[:, None] * matrix) ** 2)) / scale
        print(f"\n{len(areas)} facets; the reference took {taken:.1f} s and is good to {100 * rms(error):.4f} %")
        matrix, cpu, wall = peer(n)
        theirs = rms(matrix - truth)
        sums = matrix.sum(axis=1) - 1
        print(f"pyViewFactor       {cpu:8.2f} s   error {100 * theirs:.3f} %   |row sum - 1| up to {abs(sums).max():.4f}")
        same = None
        for tolerance in TOLERANCES:
            found, _, _, taken, (off, off_error) = steradian(program, obj, tolerance, folder)
            ours = rms(found - truth)
            z = np.max(np.abs(off) / np.maximum(off_error, 1e-7))
            print(f"steradian {tolerance:>4}     {taken:8.2f} s   error {100 * ours:.3f} %   |row sum - 1| up to {abs(off).max():.4f}, {z:.1f} standard errors")
            if same is None and ours <= theirs:
                same = (tolerance, taken, ours)
        if same:
            print(f"at the same error or less: {cpu / same[1]:.1f} times as fast (tolerance {same[0]})")


if __name__ == "__main__":
    for cuts in [int(text) for text in sys.argv[2:]] or [1, 3]:
        compare(sys.argv[1], cuts)
