#!/usr/bin/env python3
"""Render the reference picture of cornell_efficiency.py with Mitsuba and say how far it is from convergence.

usage: cornell_reference.py REFERENCE.npy [--samples 8192] [--chunk 64]

Sums independent pictures in double precision, since a film of single precision drifts when it gets all samples at once.
The relMSE of the mean is a quarter of that between its two halves; it is a floor under every relMSE measured against it.
"""

import argparse

import numpy

from cornell import Mitsuba, relative_mse

FIRST_SEED = 1_000_003
"""Far from the seeds of the pictures that are compared with the reference."""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reference")
    parser.add_argument("--samples", type=int, default=8192)
    parser.add_argument("--chunk", type=int, default=64)
    arguments = parser.parse_args()
    mitsuba = Mitsuba()
    per_half = max(1, arguments.samples // (2 * arguments.chunk))
    halves = [
        sum(mitsuba.render(arguments.chunk, seed).values for seed in range(first, first + per_half)) / per_half
        for first in (FIRST_SEED, FIRST_SEED + per_half)
    ]
    mean = (halves[0] + halves[1]) / 2
    numpy.save(arguments.reference, mean)
    own = relative_mse((halves[0] - halves[1]) / 2 + mean, mean)
    print(f"{2 * per_half * arguments.chunk} samples a pixel, mean {mean.mean(axis=(0, 1))}, own relMSE {own:.2e}")


if __name__ == "__main__":
    main()
