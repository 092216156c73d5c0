#!/usr/bin/env python3
"""Test whether Steradian and Mitsuba agree on the Cornell box, tile by tile.

usage: cornell_ttest.py STERADIAN [--filter gaussian|box] [--runs 16] [--samples 64] [--plant 1.02]

Both programs render independent pictures, one for each seed. The means of every tile of 32 × 32 pixels and every channel
over these runs are compared by Welch's t (Welch 1947, Biometrika 34): with means a and b, variances of the means u and v,
and n runs on both sides,

    t = (a - b) / √(u + v),    degrees of freedom = (n - 1) (u + v)² / (u² + v²).

A run is one number a tile, so the test needs no model of the errors within a picture. If all tiles agree, the chance of a
false alarm is at most `--false-alarm`: each test has the level 1 - (1 - false alarm)^(1 / tests) (Šidák 1967), which is
conservative here because channels and neighbouring tiles share samples.

The answer means something only if the tiles are known well, so every standard error must be within `--limit` of the tile's
mean. `--plant 1.02` makes our pictures 2 % too bright, which the test must notice.

exit status: 0 agreement, 1 disagreement, 2 the tiles are not known well enough
"""

import argparse
import sys

import numpy
from scipy import stats

from cornell import FILTERS, SIZE, Mitsuba, Steradian

MITSUBA_FIRST_SEED = 1000


def tile_means(values, tile):
    """Mean of each tile and channel, from an array of runs × height × width × channels."""
    runs, count = len(values), SIZE // tile
    return values.reshape(runs, count, tile, count, tile, 3).mean(axis=(2, 4))


def mean_and_variance(runs):
    """Of each quantity over runs; the variance is that of the mean."""
    return runs.mean(axis=0), runs.var(axis=0, ddof=1) / len(runs)


def welch(ours, theirs):
    """Statistics and two-sided p-values; where both sides are constant, equal ones agree."""
    (a, u), (b, v) = mean_and_variance(ours), mean_and_variance(theirs)
    both = u + v
    constant = both == 0
    t = numpy.where(constant, numpy.where(a == b, 0.0, numpy.inf), (a - b) / numpy.sqrt(both + constant))
    degrees = (len(ours) - 1) * both**2 / (u**2 + v**2 + constant) + constant
    return t, degrees, 2 * stats.t.sf(numpy.abs(t), degrees)


def worst_relative_error(runs):
    mean, variance = mean_and_variance(runs)
    lit = mean > 0
    return numpy.max(numpy.sqrt(variance[lit]) / mean[lit])


def error_layer_ratio(pictures):
    """Root mean square of the stated errors of pixels over that of the spread between runs."""
    values = numpy.array([picture.values for picture in pictures])
    stated = numpy.mean([picture.errors**2 for picture in pictures])
    return numpy.sqrt(stated / values.var(axis=0, ddof=1).mean())


def compare(ours, theirs, arguments):
    """Prints the result and returns the exit status."""
    t, degrees, p = welch(ours, theirs)
    level = 1 - (1 - arguments.false_alarm) ** (1 / t.size)
    errors = worst_relative_error(ours), worst_relative_error(theirs)
    print(f"worst standard error of a tile: {errors[0]:.3%} (ours), {errors[1]:.3%} (Mitsuba); limit {arguments.limit:.2%}")
    if max(errors) > arguments.limit:
        print("not known well enough: more --runs or --samples")
        return 2
    worst = numpy.unravel_index(numpy.argmin(p), p.shape)
    threshold = stats.t.isf(level / 2, degrees[worst])
    rejected = numpy.count_nonzero(p < level)
    print(f"{t.size} tests, false alarms {arguments.false_alarm:.1%}: {rejected} beyond the level {level:.2e}")
    print(f"worst: row {worst[0]}, column {worst[1]}, channel {worst[2]}: t = {t[worst]:.2f}, threshold {threshold:.2f}")
    whole = [side.mean(axis=(1, 2)) for side in (ours, theirs)]
    ratio = whole[0].mean(axis=0) / whole[1].mean(axis=0) - 1
    error = numpy.hypot(*(stats.sem(side) / side.mean(axis=0) for side in whole))
    print("whole picture, ours / Mitsuba - 1: " + ", ".join(f"{r:+.4%} ± {e:.4%}" for r, e in zip(ratio, error)))
    print("disagreement" if rejected else "agreement")
    return 1 if rejected else 0


def arguments_of_command_line():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("steradian", help="the binary")
    parser.add_argument("--filter", choices=FILTERS, default="gaussian")
    parser.add_argument("--runs", type=int, default=16)
    parser.add_argument("--samples", type=int, default=64, help="a pixel and run")
    parser.add_argument("--tile", type=int, default=32, help="pixels, a divisor of 256")
    parser.add_argument("--false-alarm", type=float, default=0.01)
    parser.add_argument("--limit", type=float, default=0.005, help="of the relative standard error of a tile")
    parser.add_argument("--plant", type=float, default=1.0, help="factor on our pictures")
    return parser.parse_args()


def main():
    arguments = arguments_of_command_line()
    steradian, mitsuba = Steradian(arguments.steradian, arguments.filter), Mitsuba(filter=arguments.filter)
    pictures = [steradian.render(arguments.samples, seed) for seed in range(arguments.runs)]
    print(f"errors of pixels, stated / observed: {error_layer_ratio(pictures):.3f}")
    ours = arguments.plant * numpy.array([picture.values for picture in pictures])
    seeds = range(MITSUBA_FIRST_SEED, MITSUBA_FIRST_SEED + arguments.runs)
    theirs = numpy.array([mitsuba.render(arguments.samples, seed).values for seed in seeds])
    return compare(tile_means(ours, arguments.tile), tile_means(theirs, arguments.tile), arguments)


if __name__ == "__main__":
    sys.exit(main())
