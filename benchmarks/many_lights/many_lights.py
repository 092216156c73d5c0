"""How long 400 points take to 2 % (95 %) under 10, 100, 1 000 and 10 000 lamps.

    python3 many_lights.py STERADIAN [--kind point|spot|panel|luminaire] [--rounds 3] [--other STERADIAN]

Processor time of all threads and time on the clock, the programs and the scenes taking turns; medians over the rounds and their
ratio to 10 lamps. With --other a second program runs the same scenes beside the first."""

import argparse
import os
import resource
import statistics
import subprocess
import tempfile
import time

import hall


def measure(program, path, tolerance):
    """Processor seconds, seconds, and whether all points came within the tolerance."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([program, "measure", path, "--rel-error", tolerance, "--format", "json"], capture_output=True, text=True)
    after, end = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    if done.returncode not in (0, 1):
        raise SystemExit(done.stderr)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, end - start, done.returncode == 0


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("program")
    arguments.add_argument("--kind", default="spot", choices=hall.LAMPS)
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--tolerance", default="2%")
    arguments.add_argument("--counts", default="10,100,1000,10000")
    arguments.add_argument("--other")
    given = arguments.parse_args()
    counts = [int(count) for count in given.counts.split(",")]
    programs = [program for program in (given.program, given.other) if program]
    taken = {}
    with tempfile.TemporaryDirectory() as folder:
        paths = {count: os.path.join(folder, f"{count}.toml") for count in counts}
        for count, path in paths.items():
            with open(path, "w") as file:
                file.write(hall.scene(count, given.kind))
        for _ in range(given.rounds):
            for count in counts:
                for program in programs:
                    taken.setdefault((program, count), []).append(measure(program, paths[count], given.tolerance))
    for program in programs:
        for count in counts:
            runs = taken[program, count]
            processor, clock = (statistics.median(run[k] for run in runs) for k in (0, 1))
            ratio = processor / statistics.median(run[0] for run in taken[program, counts[0]])
            done = "" if all(run[2] for run in runs) else "   not within the tolerance"
            print(f"{program}  {count:6} x {given.kind}  {processor:8.2f} s of processor  {clock:8.2f} s  ratio {ratio:5.2f}{done}", flush=True)


if __name__ == "__main__":
    main()
