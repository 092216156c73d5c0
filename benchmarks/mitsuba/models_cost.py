#!/usr/bin/env python3
"""Time Mitsuba's reflection models: nanoseconds for one evaluation with its density, and for one sample, on one thread.

usage: models_cost.py [--directions 4194304] [--rounds 7]

The models are those of models_ttest.py. Directions are made by the same kernel; the time of a kernel that only makes
directions and adds them up is subtracted. Medians over rounds, after a first one that compiles. Mitsuba's `llvm_ad_rgb`
evaluates 8 or 16 pairs of directions by one instruction; `cargo bench -p steradian-benches --bench brdf` times ours, which
evaluate one pair at a time.
"""

import argparse
import statistics
import time

import drjit
import mitsuba

from models_ttest import MODELS


def interaction(u, v):
    """A hit seen from a direction even over the projected hemisphere."""
    hit = drjit.zeros(mitsuba.SurfaceInteraction3f, drjit.width(u))
    hit.wi = mitsuba.warp.square_to_cosine_hemisphere(mitsuba.Point2f(u, v))
    hit.n = mitsuba.Normal3f(0, 0, 1)
    hit.sh_frame = mitsuba.Frame3f(hit.n)
    return hit


def nothing(_bsdf, hit, direction, u, _v):
    return hit.wi.x + direction.x + u


def evaluate(bsdf, hit, direction, _u, _v):
    value, density = bsdf.eval_pdf(mitsuba.BSDFContext(), hit, direction)
    return value.x + value.y + value.z + density


def sample(bsdf, hit, direction, u, v):
    drawn, weight = bsdf.sample(mitsuba.BSDFContext(), hit, u, mitsuba.Point2f(v, direction.x))
    return weight.x + weight.y + weight.z + drawn.wo.x + drawn.pdf


def seconds(task, bsdf, count, seed):
    random = mitsuba.PCG32(size=count, initstate=seed)
    drjit.eval(random)
    drjit.sync_thread()
    start = time.perf_counter()
    numbers = [random.next_float32() for _ in range(6)]
    hit = interaction(*numbers[:2])
    direction = mitsuba.warp.square_to_cosine_hemisphere(mitsuba.Point2f(*numbers[2:4]))
    drjit.eval(drjit.sum(task(bsdf, hit, direction, *numbers[4:])))
    drjit.sync_thread()
    return time.perf_counter() - start


def nanoseconds(task, bsdf, arguments):
    """Of one direction; the first round compiles."""
    times = [seconds(task, bsdf, arguments.directions, seed) for seed in range(arguments.rounds + 1)]
    return 1e9 * statistics.median(times[1:]) / arguments.directions


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--directions", type=int, default=1 << 22)
    parser.add_argument("--rounds", type=int, default=7)
    arguments = parser.parse_args()
    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(1)
    idle = nanoseconds(nothing, None, arguments)
    print(f"{'directions alone':36} {idle:6.1f} ns")
    print(f"{'model':36} evaluate and pdf   sample")
    for name, model in MODELS.items():
        bsdf = mitsuba.load_dict(model.theirs)
        evaluation, drawing = (max(0.0, nanoseconds(task, bsdf, arguments) - idle) for task in (evaluate, sample))
        print(f"{name:36} {evaluation:13.1f} ns {drawing:6.1f} ns", flush=True)


if __name__ == "__main__":
    main()
