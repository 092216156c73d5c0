#!/usr/bin/env python3
"""Form factors of pairs of unit squares, ours and pyViewFactor's: time a pair and error.

usage: pairs.py STERADIAN [--repeats 200]

STERADIAN is the built program. Both sides run one after the other on one thread; a figure is the median of its repeats.
"""

import argparse
import json
import pathlib
import re
import statistics
import subprocess
import time

import numpy
import pyvista
import pyviewfactor

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
FLOOR = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
PAIRS = {  # the second square, and the exact factor
    "parallel": ([[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]], 0.19982489569838746),
    "perpendicular": ([[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]], 0.20004377607540316),
}
MICROSECONDS = {"ns": 1e-3, "µs": 1.0, "ms": 1e3}


def cell(corners):
    return pyvista.PolyData(numpy.array(corners, float), faces=[4, 0, 1, 2, 3])


def peer(corners, repeats):
    """F from the floor and the median of microseconds; the first calls, which compile, do not count."""
    to, floor = cell(corners), cell(FLOOR)
    factor = pyviewfactor.compute_viewfactor(to, floor)
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        factor = pyviewfactor.compute_viewfactor(to, floor)
        times.append(1e6 * (time.perf_counter() - start))
    return factor, statistics.median(times)


def our_times():
    """Medians by divan, in microseconds."""
    command = ["cargo", "bench", "--quiet", "-p", "steradian-benches", "--bench", "form_factor"]
    output = subprocess.run(command, cwd=REPOSITORY, check=True, text=True, stdout=subprocess.PIPE).stdout
    row = re.compile(r"(parallel|perpendicular)\s+" + r"([\d.]+) (ns|µs|ms)\s+│\s+" * 2 + r"([\d.]+) (ns|µs|ms)")
    return {found[1]: float(found[6]) * MICROSECONDS[found[7]] for found in row.finditer(output)}


def our_factor(program, corners):
    text = lambda points: " ".join(",".join(map(str, point)) for point in points)
    command = [program, "form-factor", "--polygon1", text(FLOOR), "--polygon2", text(corners), "--format", "json"]
    return json.loads(subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout)["value"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--repeats", type=int, default=200)
    arguments = parser.parse_args()
    times = our_times()
    print("pair           ours us   error    theirs us   error    theirs/ours")
    for name, (corners, exact) in PAIRS.items():
        factor, duration = peer(corners, arguments.repeats)
        ours = our_factor(arguments.program, corners)
        print(
            f"{name:14} {times[name]:7.2f}   {abs(ours - exact):7.0e}  {duration:9.1f}   "
            f"{abs(factor - exact):7.0e}  {duration / times[name]:8.0f}"
        )


if __name__ == "__main__":
    main()
