#!/usr/bin/env python3
"""Speed and efficiency on the Cornell box: Steradian against Mitsuba's independent and multijitter samplers.

usage: cornell_efficiency.py STERADIAN REFERENCE.npy [--samples 64] [--rounds 3]

The programs take turns, one thread each, so that a change of clock or load meets all of them. With x a picture and r the
reference (cornell_reference.py makes it), over pixels and channels,

    relMSE = mean((x - r)² / (r² + 0.01)),    efficiency = 1 / (relMSE · CPU s).

Efficiency does not depend on the number of samples as long as the error falls with its square root. CPU seconds are user
and system time: of the process less that of a picture of one pixel for Steradian, of warm renders for Mitsuba.
"""

import argparse
import statistics

import numpy

from cornell import SIZE, Mitsuba, Steradian, relative_mse


def rounds(programs, reference, arguments):
    """For each round and program, CPU seconds and relMSE; Mitsuba compiles its kernels beforehand."""
    for program in programs[1:]:
        program.render(arguments.samples, arguments.rounds)
    for seed in range(arguments.rounds):
        pictures = [program.render(arguments.samples, seed) for program in programs]
        yield [(picture.cpu_seconds, relative_mse(picture.values, reference)) for picture in pictures]


def report(programs, figures, samples):
    """Medians over rounds; a ratio is that of the two programs in the same round."""
    seconds, errors = figures[..., 0], figures[..., 1]
    efficiency = 1 / (seconds * errors)
    paths = SIZE * SIZE * samples / 1e6 / seconds
    print(f"{'':22}{'CPU s':>8}{'Mpaths/CPU s':>14}{'relMSE':>11}{'efficiency':>12}{'paths ratio':>13}   efficiency ratio (range)")
    for column, program in enumerate(programs):
        ratio = efficiency[:, 0] / efficiency[:, column]
        speed = statistics.median(paths[:, 0] / paths[:, column])
        median = [statistics.median(figure[:, column]) for figure in (seconds, paths, errors, efficiency)]
        print(
            f"{program.name:22}{median[0]:8.3f}{median[1]:14.3f}{median[2]:11.3e}{median[3]:12.1f}{speed:13.2f}"
            f"   {statistics.median(ratio):.2f} ({ratio.min():.2f} to {ratio.max():.2f})"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("steradian", help="the binary")
    parser.add_argument("reference", help="what cornell_reference.py has written")
    parser.add_argument("--samples", type=int, default=64, help="a pixel")
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    programs = [Steradian(arguments.steradian), Mitsuba("independent"), Mitsuba("multijitter")]
    reference = numpy.load(arguments.reference)
    report(programs, numpy.array(list(rounds(programs, reference, arguments))), arguments.samples)


if __name__ == "__main__":
    main()
