#!/usr/bin/env python3
"""Seconds to 1 % of the irradiance at 20 x 20 points of a floor, beside Radiance's `rtrace -I` and Mitsuba 3.

usage: grid.py [--program STERADIAN] [--radiance FOLDER] [--rounds 5] [--quick]

FOLDER holds Radiance's `oconv` and `rtrace`. Mitsuba is asked if this Python has it.

The scenes are the Cornell box (its lamp black by itself, as Radiance's `light` is) and the room under the sky of
benchmarks/scenes, both with light of at most 8 reflections. Points that lie inside a box or on its faces are left out. One thread each, processor time.

- Ours runs `measure --rel-error 1%`: until the 95 % interval of every point is within 1 % of its value. The time is all of it:
  reading, a pilot that is thrown away, and the run itself.
- The others take a fixed number of samples a point. Their seconds are those of one run times (e / .51 %)², with e the root mean
  square over the points of the relative error of that run: .51 % is the standard error whose 95 % interval is 1 %. So it is foretold, not
  run, that they need so long, and that the mean square of all points gets there, not each of them. Loading and compiling do not count.
- `root mean square` runs `measure --rms-error 1%`, which asks ours what the others are foretold for: that the root mean square over the points of the
  half-widths is 1 % of the values. Samples are shared out among the points; pilot and all count.
- `same error` asks ours the same question as the others: a fixed number of samples, its root mean square error, seconds foretold.

The truth that errors are measured from is the mean over the rounds of our runs to 1 %, whose points have a standard error of some .3 % in each, and
the table is followed by how far the mean over the points of each program is off it.

Radiance: `-ab 8 -ad 1024 -lw 1e-6 -aa 0 -u+`, no cache of irradiance. Mitsuba (`llvm_ad_rgb`): its irradiance meter sends no rays to
lights, so rays look straight down at the floor from 1 mm, where light is sampled: E = pi L / reflectance; multijitter sampler.
"""

import csv
import math
import os
import pathlib
import sys
import tempfile
import time
import typing

import numpy

import measure

sys.path.insert(0, str(measure.REPOSITORY / "benchmarks" / "scenes"))

WANTED = 0.01 / 1.959964
REFLECTIONS = 8
SAMPLES = 4096
"""A point, of each side where the number is fixed."""
LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])
RADIANCE_OPTIONS = f"-ab {REFLECTIONS} -ad 1024 -lw 1e-6 -aa 0 -u+".split()
MITSUBA_INSTALL = "python3 -m venv venv && venv/bin/pip install mitsuba numpy, and give venv/bin/python by --mitsuba"
RADIANCE_INSTALL = "venv/bin/pip install pyradiance, and give the folder pyradiance/bin of its package by --radiance"


def grid(count=20):
    return (numpy.arange(count) + 0.5) / count


class Cornell:
    """y is up."""

    name = "Cornell box"
    up = (0, 1, 0)
    reflectance = numpy.array([0.885809, 0.698859, 0.666422])
    # Middle and angle of the boxes, whose half width is .3.
    boxes = ((0.335, 0.38, -17.0), (-0.33, -0.28, 18.25))

    def points(self):
        return numpy.array([(x, -0.999, z) for z in 2 * grid() - 1 for x in 2 * grid() - 1 if not self.inside(x, z)])

    def inside(self, x, z):
        for middle_x, middle_z, degrees in self.boxes:
            angle = math.radians(degrees)
            dx, dz = x - middle_x, z - middle_z
            along = dx * math.cos(angle) - dz * math.sin(angle), dx * math.sin(angle) + dz * math.cos(angle)
            if max(map(abs, along)) < 0.3:
                return True
        return False

    def ours(self):
        text = (measure.REPOSITORY / "scenes" / "cornell-box.toml").read_text()
        return text.replace('front = "white"', 'front = "black"')

    def mitsuba(self):
        import mitsuba

        scene = mitsuba.cornell_box()
        scene["light"]["bsdf"] = {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.0, 0.0, 0.0]}}
        del scene["sensor"]
        return scene

    def radiance(self):
        white, green, red = (0.885809, 0.698859, 0.666422), (0.105421, 0.37798, 0.076425), (0.570068, 0.0430135, 0.0443706)
        text = "".join(plastic(name, color) for name, color in (("white", white), ("green", green), ("red", red)))
        text += "void light lamp\n0\n0\n3 18.387 13.9873 6.75357\n"
        for material, corner, first, second in (
            ("white", (-1, -1, 1), (2, 0, 0), (0, 0, -2)),
            ("white", (-1, 1, -1), (2, 0, 0), (0, 0, 2)),
            ("white", (-1, -1, -1), (2, 0, 0), (0, 2, 0)),
            ("green", (1, -1, -1), (0, 0, 2), (0, 2, 0)),
            ("red", (-1, -1, -1), (0, 2, 0), (0, 0, 2)),
            ("lamp", (-0.23, 0.99, -0.18), (0.46, 0, 0), (0, 0, 0.38)),
        ):
            text += polygon(material, corner, first, second)
        for (x, z, degrees), height in zip(self.boxes, (0.3, 0.61)):
            turn = f"-s 1 -ry {degrees} -t {x} {height - 1} {z}"
            text += f"!genbox white box{height} .6 {2 * height} .6 | xform -t -.3 {-height} -.3 {turn}\n"
        return text


class SkyRoom:
    """z is up; the block stands on x 2.3 to 2.9, y 2.6 to 3.2."""

    name = "Room under the sky"
    up = (0, 0, 1)
    reflectance = numpy.array([0.45, 0.33, 0.22])

    def points(self):
        every = [(4 * x, 5 * y, 0.001) for y in grid() for x in grid()]
        return numpy.array([point for point in every if not (2.25 < point[0] < 2.95 and 2.55 < point[1] < 3.25)])

    def ours(self):
        return (measure.REPOSITORY / "benchmarks" / "scenes" / "sky_room.toml").read_text()

    def mitsuba(self):
        import sky_room

        scene = sky_room.theirs(None)
        del scene["sensor"]
        return scene

    def radiance(self):
        text = plastic("white", (0.7,) * 3) + plastic("floor", self.reflectance)
        text += "void glow bright\n0\n0\n4 1 1 1 0\nbright source sky\n0\n0\n4 0 0 1 360\n"
        x, y, z = (4, 0, 0), (0, 5, 0), (0, 0, 2.6)
        for material, corner, first, second in (
            ("floor", (0, 0, 0), x, y),
            ("white", (0, 0, 2.6), y, x),
            ("white", (0, 0, 0), y, z),
            ("white", (4, 0, 0), z, y),
            ("white", (0, 0, 0), z, x),
            ("white", (0, 5, 0), (0.5, 0, 0), z),
            ("white", (3.5, 5, 0), (0.5, 0, 0), z),
            ("white", (0.5, 5, 0), (3, 0, 0), (0, 0, 0.9)),
            ("white", (0.5, 5, 2.3), (3, 0, 0), (0, 0, 0.3)),
        ):
            text += polygon(material, corner, first, second)
        return text + "!genbox white block .6 .6 .7 | xform -t 2.3 2.6 0\n"


def plastic(name, color):
    """Without a gloss: a diffuse surface."""
    return "void plastic {}\n0\n0\n5 {} {} {} 0 0\n".format(name, *color)


def polygon(material, corner, first, second):
    corner, first, second = map(numpy.array, (corner, first, second))
    corners = (corner, corner + first, corner + first + second, corner + second)
    polygon.count = getattr(polygon, "count", 0) + 1
    numbers = " ".join(f"{value:.9g}" for point in corners for value in point)
    return f"{material} polygon p{polygon.count}\n0\n0\n12 {numbers}\n"


class Steradian:
    def __init__(self, program, scene, folder):
        rows = ", ".join(f"[{', '.join(f'{value:.9g}' for value in (*point, *scene.up))}]" for point in scene.points())
        self.scene, self.output = folder / "scene.toml", folder / "out.csv"
        self.scene.write_text(f'{scene.ours()}\n[[sensors]]\nname = "floor"\nkind = "irradiance"\npoints = [{rows}]\n')
        self.command = [program, "measure", self.scene, "--sensor", "floor", "--max-depth", REFLECTIONS + 1]
        self.command += ["--threads", 1, "--format", "csv", "-o", self.output]

    def run(self, *until, seed):
        """Processor seconds and values."""
        cost = measure.run([*self.command, *until, "--seed", seed], accept=(0, 1))
        with open(self.output, newline="") as file:
            rows = list(csv.DictReader(file))
        return cost.cpu_seconds, numpy.array([float(row["value"]) for row in rows])


class Mitsuba:
    def __init__(self, scene):
        import drjit
        import mitsuba

        self.mitsuba, self.drjit = mitsuba, drjit
        mitsuba.set_variant("llvm_ad_rgb")
        drjit.set_thread_count(1)
        self.name = f"Mitsuba {mitsuba.__version__} llvm_ad_rgb"
        # The first segment leads down to the floor, one more to its first reflection.
        description = scene.mitsuba() | {"integrator": {"type": "path", "max_depth": REFLECTIONS + 2, "rr_depth": 100}}
        self.scene = mitsuba.load_dict(description)
        self.points, self.up, self.reflectance = scene.points(), scene.up, scene.reflectance

    def run(self, samples, seed):
        mitsuba, drjit, count = self.mitsuba, self.drjit, len(self.points)
        start = time.process_time()
        sampler = mitsuba.load_dict({"type": "multijitter", "sample_count": samples})
        sampler.set_samples_per_wavefront(samples)
        sampler.seed(seed, count * samples)
        index = drjit.arange(mitsuba.UInt32, count * samples) // samples
        origin = drjit.gather(mitsuba.Point3f, mitsuba.Point3f(self.points.T.astype(numpy.float32)), index)
        ray = mitsuba.RayDifferential3f(origin, mitsuba.Vector3f(*(-float(value) for value in self.up)))
        radiance, _, _ = self.scene.integrator().sample(self.scene, sampler, ray)
        sums = numpy.array(drjit.block_sum(mitsuba.Color3f(radiance), samples)).reshape(3, -1).T.astype(float)
        seconds = time.process_time() - start
        return seconds, (sums / samples * math.pi / self.reflectance) @ LUMINANCE


class Radiance:
    def __init__(self, programs, scene, folder):
        library = programs.parent / "lib"
        self.environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}", "RAYPATH": f".:{library}"}
        version = measure.run(["rtrace", "-version"], env=self.environment).text().split()
        self.name = " ".join(["Radiance", *version[1:2]])
        self.octree, self.points = folder / "scene.oct", folder / "points.txt"
        (folder / "scene.rad").write_text(scene.radiance())
        self.octree.write_bytes(measure.run(["oconv", folder / "scene.rad"], env=self.environment).output)
        rows = [" ".join(f"{value:.9g}" for value in (*point, *scene.up)) for point in scene.points()]
        self.points.write_text("\n".join(rows) + "\n")

    def run(self, options):
        with open(self.points, "rb") as points:
            cost = measure.run(["rtrace", "-I", "-h", *options, self.octree], stdin=points, env=self.environment)
        values = numpy.array(cost.text().split(), float).reshape(-1, 3)
        return cost.cpu_seconds, values @ LUMINANCE


def error(values, truth):
    """Root mean square of relative errors."""
    return math.sqrt(numpy.mean((values / truth - 1) ** 2))


def foretold(seconds, values, truth):
    return seconds * (error(values, truth) / WANTED) ** 2


class Peer(typing.NamedTuple):
    name: str
    run: typing.Callable
    """Processor seconds and values, given a seed."""
    how: str


def peers_of(scene, given, folder):
    """Those that are there; a warm-up of Mitsuba compiles its kernel."""
    found = []
    try:
        mitsuba = Mitsuba(scene)
        mitsuba.run(SAMPLES, given.rounds)
        how = f"{SAMPLES} samples a point, multijitter, looking down at the floor"
        found.append(Peer(mitsuba.name, lambda seed: mitsuba.run(SAMPLES, seed), how))
    except ImportError:
        measure.missing("Mitsuba", MITSUBA_INSTALL)
    if given.radiance:
        radiance = Radiance(given.radiance, scene, folder)
        found.append(Peer(radiance.name, lambda _seed: radiance.run(RADIANCE_OPTIONS), " ".join(RADIANCE_OPTIONS)))
    else:
        measure.missing("Radiance", RADIANCE_INSTALL)
    return found


def compare(scene, given, folder):
    ours, peers = Steradian(given.program, scene, folder), peers_of(scene, given, folder)
    to_tolerance, together, fixed, theirs = [], [], [], {peer.name: [] for peer in peers}
    for round in range(given.rounds):
        measure.progress(f"grid: {scene.name}, round {round + 1} of {given.rounds}")
        to_tolerance.append(ours.run("--rel-error", "1%", seed=round))
        together.append(ours.run("--rms-error", "1%", seed=round))
        fixed.append(ours.run("--samples", SAMPLES, seed=given.rounds + round))
        for peer in peers:
            theirs[peer.name].append(peer.run(round))
    truth = numpy.mean([values for _, values in to_tolerance], axis=0)
    for peer in peers:
        report(scene, peer, (to_tolerance, together, fixed), theirs[peer.name], truth)
        tell(scene, peer.name, theirs[peer.name], truth)
    tell(scene, "ours, root mean square to 1 %", together, truth)
    tell(scene, f"ours, {SAMPLES} samples a point", fixed, truth)
    if not peers:
        for round, (seconds, _) in enumerate(to_tolerance):
            measure.figure(f"{scene.name}, irradiance to 1 %", "CPU s", seconds, round=round, better="less", how=settings(truth))


def settings(truth):
    return f"{len(truth)} points, {REFLECTIONS} reflections, 1 thread; ours Sobol', every 95 % interval within 1 %"


def report(scene, peer, ours, theirs, truth):
    """The figures of all rounds beside one peer."""
    same = f"{len(truth)} points, {REFLECTIONS} reflections, 1 thread; both foretold for a standard error of .51 %; ours {SAMPLES} samples a point"
    both = f"{len(truth)} points, {REFLECTIONS} reflections, 1 thread; ours Sobol', to a standard error of .51 % in the root mean square"
    rounds = enumerate(zip(*ours, theirs))
    for round, ((seconds, _), (together, _), fixed, (their_seconds, their_values)) in rounds:
        common = {"round": round, "better": "less", "goal": 10.0, "peer": peer.name, "theirs": foretold(their_seconds, their_values, truth)}
        measure.figure(f"{scene.name}, irradiance to 1 %", "CPU s", seconds, how=f"{settings(truth)}; theirs foretold: {peer.how}", **common)
        measure.figure(f"{scene.name}, irradiance, root mean square", "CPU s", together, how=f"{both}; theirs foretold: {peer.how}", **common)
        measure.figure(f"{scene.name}, irradiance, same error", "CPU s", foretold(*fixed, truth), how=f"{same}; theirs {peer.how}", **common)


def tell(scene, name, runs, truth):
    """How far a program's runs are off the truth; a standard error comes from the spread over the points, as runs may share random numbers."""
    off = numpy.mean([values for _, values in runs], axis=0) / truth - 1
    every = numpy.array([values / truth - 1 for _, values in runs])
    measure.note(
        f"{scene.name}, {len(truth)} points: {name}: root mean square error of a run {math.sqrt(numpy.mean(every**2)):.2%}, worst point {abs(every).max():.1%}, "
        f"mean over the points {off.mean():+.3%} ± {off.std(ddof=1) / math.sqrt(len(off)):.3%}; {runs[0][0]:.2f} CPU s a run"
    )


def main():
    given = measure.options(__doc__, radiance={"type": pathlib.Path, "default": os.environ.get("STERADIAN_RADIANCE")})
    for scene in (Cornell(), SkyRoom()):
        with tempfile.TemporaryDirectory(prefix="steradian-grid-") as folder:
            compare(scene, given, pathlib.Path(folder))


if __name__ == "__main__":
    main()
