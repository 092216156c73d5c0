#!/usr/bin/env python3
"""Correct digits per processor second of pictures: 1 / (relMSE · CPU s), beside Mitsuba 3 on the same scenes.

usage: pictures.py --scenes SCENE … [--program STERADIAN] [--cycles PYTHON] [--rounds 5] [--quick] [--bathroom bathroom_cc0.glb]

SCENE is a module of benchmarks/scenes: cornell, veach_mis, bathroom, hall, glass_ball, sky_room. Run it by a Python that has mitsuba.

Both sides take the same samples a pixel and cut paths off at the same number of segments; Gaussian filter of σ = ½ pixel, one
thread. Ours draws Owen-scrambled Sobol' points. Mitsuba's `llvm_ad_rgb` and `scalar_rgb` use the multijitter sampler, its best.
CPU seconds are user and system time: of our process less those of a picture of one pixel and no segments, so that pilots count; of Mitsuba's warm renders, without
loading and compiling. Cycles (`--cycles PYTHON`, a Python that has bpy) renders the Cornell box by its default sampler; its
CPU seconds are less those of a picture of 16 x 16 pixels.

The reference of a scene is the mean of 16 long pictures of ours. It counts only if Mitsuba's mean of as many pictures agrees: Welch's t over
tiles and channels, at a level that leaves a family-wise false alarm of 1 % (Šidák 1967). With x a picture and r the reference,
over channels and all pixels but the outermost two,

    relMSE = mean((x - r)² / (r² + f)) - what the reference's own error adds,

with f = 0.01 for the Cornell box, as others have it, and 0.01 times the square of the mean of r elsewhere, so that the figure does
not depend on the unit of radiance. The own error comes from the spread of the 16 pictures.
"""

import hashlib
import importlib
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import typing

import numpy

import measure

sys.path.insert(0, str(measure.REPOSITORY / "benchmarks" / "scenes"))
sys.path.insert(0, str(measure.REPOSITORY / "benchmarks"))
from pfm import read_pfm

SCENES = ("cornell", "veach_mis", "bathroom", "hall", "glass_ball", "sky_room")
RUNS = 16
OUR_REFERENCE_SEED, THEIR_REFERENCE_SEED = 1_000_003, 2_000_003
BORDER = 2
"""Pixels at the rim, where the two programs treat the filter differently."""
FALSE_ALARM = 0.01
GOALS = {"cornell": 3.0}
INSTALL = "python3 -m venv venv && venv/bin/pip install mitsuba, and give venv/bin/python by --mitsuba (DRJIT_LIBLLVM_PATH names libLLVM.so)"
CYCLES_INSTALL = "python3 -m venv venv-bpy && venv-bpy/bin/pip install bpy, and give venv-bpy/bin/python by --cycles"


class Picture(typing.NamedTuple):
    values: numpy.ndarray
    """Radiance by row from the top, column and channel."""
    cpu_seconds: float


class Steradian:
    def __init__(self, program, scene, folder):
        path = scene.ours(folder)
        self.command = [program, "render", path, "--filter", "gaussian", "--threads", 1]
        self.depth, self.folder = scene.DEPTH, folder
        self.start_up = self.run(4, 0, 0, "--resolution", "1x1").cpu_seconds

    def render(self, samples, seed):
        picture = self.run(samples, seed, self.depth)
        return picture._replace(cpu_seconds=picture.cpu_seconds - self.start_up)

    def run(self, samples, seed, depth, *more):
        output = self.folder / "picture.pfm"
        cost = measure.run([*self.command, "--max-depth", depth, "--samples", samples, "--seed", seed, "-o", output, *more], accept=(0, 1))
        return Picture(read_pfm(output), cost.cpu_seconds)


class Mitsuba:
    def __init__(self, scene, variant, samples, folder):
        import drjit
        import mitsuba

        self.mitsuba, self.variant = mitsuba, variant
        mitsuba.set_variant(variant)
        drjit.set_thread_count(1)
        description = scene.theirs(folder)
        description["integrator"] = {"type": "path", "max_depth": scene.DEPTH}
        sensor = description["sensor"]
        film = {"type": "hdrfilm", "width": scene.SIZE[0], "height": scene.SIZE[1], "rfilter": {"type": "gaussian"}, "pixel_format": "rgb"}
        sensor["film"] = film | {"component_format": "float32"}
        sensor["sampler"] = {"type": "multijitter", "sample_count": samples}
        self.scene = mitsuba.load_dict(description)

    def render(self, samples, seed):
        """The first call also compiles the kernel, which later ones of the same process do not."""
        self.mitsuba.set_variant(self.variant)
        start = time.process_time()
        values = numpy.array(self.mitsuba.render(self.scene, spp=samples, seed=seed))
        return Picture(values[..., :3].astype(float), time.process_time() - start)


class Cycles:
    """Another Python renders on demand, where a scene has a program for it."""

    def __init__(self, python, scene, folder):
        self.output, self.size = folder / "cycles.npy", scene.SIZE[0]
        command = [python, pathlib.Path(__file__).with_name(scene.CYCLES), self.output]
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
        self.process = subprocess.Popen([*map(str, command)], text=True, bufsize=1, **pipes)
        self.name = f"Cycles {self.process.stdout.readline().strip()}"
        self.start_up = self.ask(4, 0, 16)

    def ask(self, samples, seed, size):
        print(samples, seed, size, file=self.process.stdin, flush=True)
        return float(self.process.stdout.readline())

    def render(self, samples, seed):
        seconds = self.ask(samples, seed, self.size) - self.start_up
        return Picture(numpy.load(self.output).astype(float), seconds)


def inner(picture):
    return picture[..., BORDER:-BORDER, BORDER:-BORDER, :]


def relative_square(difference, reference, floor):
    """Mean of squares, relative to the reference as relMSE is."""
    return numpy.mean(inner(difference) ** 2 / (inner(reference) ** 2 + floor))


def floor_of(scene, reference):
    return getattr(scene, "FLOOR", 0.01 * inner(reference).mean() ** 2)


def tiles(picture, count=8):
    """Means over a grid of tiles, by channel."""
    rows = numpy.array_split(inner(picture), count, axis=0)
    return numpy.array([[tile.mean(axis=(0, 1)) for tile in numpy.array_split(row, count, axis=1)] for row in rows])


def p_value(t, degrees):
    """Two-sided, of Student's t, by Wallace's transformation to a normal deviate (1959, Ann. Math. Stat. 30): within 1 % from 10 degrees on."""
    z = (8 * degrees + 1) / (8 * degrees + 3) * math.sqrt(degrees * math.log1p(t * t / degrees))
    return math.erfc(z / math.sqrt(2))


def welch(ours, theirs):
    """The largest |t| over tiles and channels, and the smallest p-value corrected for their number."""
    (a, u), (b, v) = ((side.mean(axis=0), side.var(axis=0, ddof=1) / len(side)) for side in (ours, theirs))
    both = u + v
    t = numpy.abs(a - b) / numpy.sqrt(both + (both == 0))
    degrees = (len(ours) - 1) * both**2 / (u**2 + v**2 + (both == 0))
    smallest = min(p_value(*pair) for pair in zip(t.ravel(), degrees.ravel()) if pair[1] > 0)
    return t.max(), 1 - (1 - smallest) ** t.size


def worst_error(runs):
    """Of the tiles on which light falls, relative."""
    mean, spread = runs.mean(axis=0), runs.std(axis=0, ddof=1)
    return numpy.max(spread[mean > 0] / mean[mean > 0]) / math.sqrt(len(runs))


class Reference(typing.NamedTuple):
    mean: numpy.ndarray
    floor: float
    own: float
    """relMSE of the mean itself."""
    tiles: numpy.ndarray
    """Of each run."""


def reference(scene, program, samples, first_seed, kept):
    """Renders the runs of one side, or reads them where they are kept."""
    if kept.exists():
        loaded = numpy.load(kept)
        return Reference(loaded["mean"], float(loaded["floor"]), float(loaded["own"]), loaded["tiles"])
    pictures = numpy.array([program.render(samples, first_seed + run).values for run in range(RUNS)])
    mean = pictures.mean(axis=0)
    floor = floor_of(scene, mean)
    own = numpy.mean([relative_square(picture - mean, mean, floor) for picture in pictures]) / (RUNS - 1)
    found = Reference(mean, float(floor), float(own), numpy.array([tiles(picture) for picture in pictures]))
    numpy.savez(kept, **found._asdict())
    return found


def key(scene, name, samples):
    """A name for what is kept, that changes with the scene."""
    digest = hashlib.blake2b(digest_size=6)
    with tempfile.TemporaryDirectory() as folder:
        digest.update(pathlib.Path(scene.ours(pathlib.Path(folder))).read_bytes())
    digest.update(pathlib.Path(scene.__file__).read_bytes())
    digest.update(repr((samples, RUNS, scene.SIZE, scene.DEPTH)).encode())
    return f"{name}-{digest.hexdigest()}"


def agreed(name, scene, ours, theirs, samples, cache):
    """The reference, or nothing if the two programs' pictures differ."""
    stem = key(scene, name, samples)
    mine = reference(scene, ours, samples, OUR_REFERENCE_SEED, cache / f"{stem}-ours.npz")
    if not theirs:
        return mine
    other = reference(scene, theirs, samples, THEIR_REFERENCE_SEED, cache / f"{stem}-mitsuba.npz")
    worst, p = welch(mine.tiles, other.tiles)
    ratio = mine.tiles.mean() / other.tiles.mean() - 1
    error = math.hypot(*(side.tiles.mean(axis=(1, 2, 3)).std(ddof=1) / math.sqrt(RUNS) / side.tiles.mean() for side in (mine, other)))
    tile_error = [worst_error(side.tiles) for side in (mine, other)]
    verdict = "agree" if p >= FALSE_ALARM else "DIFFER: no ratio is reported"
    measure.note(
        f"{scene.NAME}: {RUNS} x {samples} samples a pixel of each side {verdict}: worst |t| of {mine.tiles[0].size} tile means {worst:.2f} "
        f"(p {p:.2g} in all), whole picture ours / Mitsuba's - 1 = {ratio:+.3%} ± {error:.3%}, worst standard error of a tile {tile_error[0]:.2%} "
        f"and {tile_error[1]:.2%}; relMSE of the reference itself {mine.own:.1e}"
    )
    return mine if p >= FALSE_ALARM else None


def efficiency(picture, truth):
    error = relative_square(picture.values - truth.mean, truth.mean, truth.floor) - truth.own
    return 1 / (picture.cpu_seconds * error)


def report(name, scene, picture, peers, truth, samples, round):
    """The figures of one round."""
    width, height = scene.SIZE
    how = f"{width}x{height}, {samples} spp, at most {scene.DEPTH} segments, Gaussian σ=½, 1 thread; Sobol', Mitsuba multijitter, Cycles default"
    millions = width * height * samples / 1e6
    for peer, theirs in peers:
        common = {"round": round, "peer": peer, "how": how}
        goal = GOALS.get(name, 1.0) if "llvm" in peer else 1.0
        if "Cycles" in peer:
            off = inner(theirs.values).mean() / inner(truth.mean).mean() - 1
            measure.note(f"{scene.NAME}: {peer}, round {round + 1}: whole picture over the reference - 1 = {off:+.3%}")
        measure.figure(
            f"{scene.NAME}, 1/(relMSE·CPU s)", "1/s", efficiency(picture, truth), theirs=efficiency(theirs, truth), goal=goal, **common
        )
        if "llvm" in peer:
            measure.figure(
                f"{scene.NAME}, samples", "Msamples/CPU s", millions / picture.cpu_seconds, theirs=millions / theirs.cpu_seconds, **common
            )
    if not peers:
        measure.figure(f"{scene.NAME}, 1/(relMSE·CPU s)", "1/s", efficiency(picture, truth), round=round, how=how)


def compare(name, given, mitsuba, folder):
    scene = importlib.import_module(name)
    if hasattr(scene, "prepare") and not scene.prepare(given):
        return measure.missing(scene.NAME, scene.INSTALL)
    samples, long = (16, 64) if given.quick else (scene.SAMPLES, scene.LONG)
    ours = Steradian(given.program, scene, folder)
    peers = {}
    if mitsuba:
        variants = ("llvm_ad_rgb",) if given.quick else ("llvm_ad_rgb", "scalar_rgb")
        peers = {f"Mitsuba {mitsuba.__version__} {variant}": Mitsuba(scene, variant, samples, folder) for variant in variants}
    first = next(iter(peers.values()), None)
    if hasattr(scene, "CYCLES") and given.cycles:
        cycles = Cycles(given.cycles, scene, folder)
        peers[cycles.name] = cycles
    elif hasattr(scene, "CYCLES"):
        measure.missing("Cycles", CYCLES_INSTALL)
    measure.progress(f"{name}: reference")
    truth = agreed(name, scene, ours, first, long, given.cache)
    if not truth:
        return None
    for peer in peers.values():
        peer.render(samples, given.rounds)
    for round in range(given.rounds):
        measure.progress(f"{name}: round {round + 1} of {given.rounds}")
        picture = ours.render(samples, round)
        report(name, scene, picture, [(label, peer.render(samples, round)) for label, peer in peers.items()], truth, samples, round)


def main():
    given = measure.options(
        __doc__,
        scenes={"nargs": "+", "choices": SCENES, "default": SCENES, "metavar": "SCENE"},
        cycles={"type": pathlib.Path, "default": os.environ.get("STERADIAN_CYCLES")},
        bathroom={"type": pathlib.Path, "default": os.environ.get("STERADIAN_BATHROOM")},
    )
    try:
        import mitsuba
    except ImportError:
        mitsuba = None
        measure.missing("Mitsuba", INSTALL)
    with tempfile.TemporaryDirectory(prefix="steradian-suite-") as folder:
        for name in given.scenes:
            compare(name, given, mitsuba, pathlib.Path(folder))


if __name__ == "__main__":
    main()
