#!/usr/bin/env python3
"""Test whether Steradian and Mitsuba agree on the measured Cornell box by wavelength.

usage: cornell_spectral.py STERADIAN [--runs 12] [--samples 64] [--floor-samples 262144] [--plant 1.02]

Both programs compute `scenes/cornell-spectral.toml` with paths of any length; Mitsuba's scene is built from the very numbers
of that file. Two things are compared over independent runs by Welch's t (see cornell_ttest.py):

- the flux on the floor in three intervals of 100 nm, Mitsuba's as the mean irradiance times the area,
- X, Y, Z of each tile of the picture: Mitsuba's film is given the 1931 observer every nm, so that both use one observer;
  our pictures hold linear Rec.709, which a matrix takes to X, Y, Z.

The lamp emits 0 to 0.184 W/(m2 sr nm) between 400 and 700 nm and nothing elsewhere, in both programs.

exit status: 0 agreement, 1 disagreement, 2 the tiles are not known well enough
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import drjit
import mitsuba
import numpy
from scipy import stats

from cornell import read_pfm
from cornell_ttest import mean_and_variance, welch, worst_relative_error

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "scenes" / "cornell-spectral.toml"
OBSERVER = ROOT / "crates" / "steradian" / "data" / "spectra" / "cie_1931.csv"
SIZE, TILE = 128, 16
BINS = [(400, 500), (500, 600), (600, 700)]
MITSUBA_FIRST_SEED = 1000
# X, Y, Z of linear Rec.709 (ITU-R BT.709-6, white D65).
XYZ_OF_RGB = numpy.array(
    [[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]]
)


class Steradian:
    def __init__(self, program):
        self.program = str(program)

    def run(self, *arguments):
        command = [self.program, *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    def floor(self, samples, seed):
        text = self.run("measure", SCENE, "--sensor", "floor", "--samples", samples, "--seed", seed, "--format", "json")
        readings = json.loads(text)["readings"]
        return [next(r["value"] for r in readings if f"{low}-{high} nm" in r["quantity"]) for low, high in BINS]

    def picture(self, samples, seed):
        with tempfile.TemporaryDirectory(prefix="steradian-spectral-") as directory:
            output = pathlib.Path(directory, "picture.pfm")
            options = ["--samples", samples, "--seed", seed, "--filter", "box", "--resolution", f"{SIZE}x{SIZE}"]
            self.run("render", SCENE, *options, "-o", output)
            return read_pfm(output) @ XYZ_OF_RGB.T


def table(samples):
    """A spectrum of Mitsuba through these samples, 0 elsewhere."""
    wavelengths, values = zip(*samples)
    text = lambda numbers: ", ".join(f"{number:.9g}" for number in numbers)
    return {"type": "irregular", "wavelengths": text(wavelengths), "values": text(values)}


def spectrum(value):
    return table([(360, value), (830, value)] if isinstance(value, (int, float)) else value)


def triangles(shape):
    """Vertices and triangles of a mesh, or of a polygon with four corners that may have a hole with four."""
    if shape["kind"] == "mesh":
        return shape["vertices"], shape["triangles"]
    outer = shape["vertices"]
    if "holes" not in shape:
        return outer, [[0, 1, 2], [0, 2, 3]]
    (hole,) = shape["holes"]
    nearest = [4 + min(range(4), key=lambda j: numpy.linalg.norm(numpy.subtract(hole[j], corner))) for corner in outer]
    ring = []
    for i in range(4):
        j = (i + 1) % 4
        ring += [[i, j, nearest[i]], [j, nearest[j], nearest[i]]]
    return outer + hole, ring


def mesh(name, shape, properties):
    vertices, faces = triangles(shape)
    made = mitsuba.Mesh(name, len(vertices), len(faces), props=properties)
    parameters = mitsuba.traverse(made)
    parameters["vertex_positions"] = numpy.ravel(vertices).astype(numpy.float32)
    parameters["faces"] = numpy.ravel(faces).astype(numpy.uint32)
    parameters.update()
    return made


def observer():
    rows = numpy.loadtxt(OBSERVER, delimiter=",", skiprows=1)
    return {name: table(zip(rows[:, 0], rows[:, i])) for i, name in ((1, "x"), (2, "y"), (3, "z"))}


def film(size, responses):
    return {"type": "specfilm", "width": size, "height": size, "rfilter": {"type": "box"}, **responses}


class Mitsuba:
    def __init__(self):
        mitsuba.set_variant("llvm_ad_spectral")
        drjit.set_thread_count(1)
        with open(SCENE, "rb") as file:
            self.file = tomllib.load(file)
        self.shapes = {shape["name"]: shape for shape in self.file["shapes"]}
        bins = {f"bin{low}": table([(low, 1), (high, 1)]) for low, high in BINS}
        sampler = {"type": "independent", "sample_count": 64}
        meter = {"type": "irradiancemeter", "sampler": sampler, "film": film(1, bins)}
        self.floor_scene = self.scene({"floor": meter})
        self.picture_scene = self.scene({}, {"camera": self.camera(sampler)})
        vertices = numpy.array(self.shapes["floor"]["vertices"])
        self.floor_area = sum(
            0.5 * numpy.linalg.norm(numpy.cross(vertices[b] - vertices[a], vertices[c] - vertices[a]))
            for a, b, c in triangles(self.shapes["floor"])[1]
        )

    def camera(self, sampler):
        camera = next(sensor for sensor in self.file["sensors"] if sensor["kind"] == "camera")
        view = mitsuba.ScalarTransform4f().look_at(camera["position"], camera["look_at"], [0, 1, 0])
        fov = float(camera["fov"].split()[0])
        responses = observer()
        return {"type": "perspective", "fov": fov, "to_world": view, "sampler": sampler, "film": film(SIZE, responses)}

    def scene(self, sensors_of_shapes, more={}):
        scene = {"type": "scene", "integrator": {"type": "path", "max_depth": -1}, **more}
        for name, shape in self.shapes.items():
            scene[name.replace(" ", "_")] = self.shape(name, shape, sensors_of_shapes.get(name))
        return mitsuba.load_dict(scene)

    def shape(self, name, shape, sensor):
        properties = mitsuba.Properties()
        reflectance = spectrum(self.file["materials"][shape["material"]]["reflectance"])
        diffuse = {"type": "twosided", "inner": {"type": "diffuse", "reflectance": reflectance}}
        properties["bsdf"] = mitsuba.load_dict(diffuse)
        if "emission" in shape:
            emission = shape["emission"]
            nodes, values = zip(*emission["spectrum"])
            factor = float(emission["radiance"].split()[0]) / numpy.trapezoid(values, nodes)
            radiance = [(node, factor * value) for node, value in zip(nodes, values)]
            properties["emitter"] = mitsuba.load_dict({"type": "area", "radiance": table(radiance)})
        if sensor is not None:
            properties["sensor"] = mitsuba.load_dict(sensor)
        return mesh(name, shape, properties)

    def floor(self, samples, seed):
        values = numpy.array(mitsuba.render(self.floor_scene, spp=samples, seed=seed), dtype=float)
        return values.ravel()[: len(BINS)] * self.floor_area

    def picture(self, samples, seed):
        return numpy.array(mitsuba.render(self.picture_scene, spp=samples, seed=seed), dtype=float)[..., :3]


def tile_means(pictures):
    count = SIZE // TILE
    return pictures.reshape(len(pictures), count, TILE, count, TILE, 3).mean(axis=(2, 4))


def compare(name, ours, theirs, arguments):
    """Prints the result and returns the exit status."""
    t, degrees, p = welch(ours, theirs)
    level = 1 - (1 - arguments.false_alarm) ** (1 / t.size)
    errors = worst_relative_error(ours), worst_relative_error(theirs)
    rejected = numpy.count_nonzero(p < level)
    worst = numpy.unravel_index(numpy.argmin(p), p.shape)
    threshold = stats.t.isf(level / 2, degrees[worst])
    print(f"{name}: worst standard error {errors[0]:.3%} (ours), {errors[1]:.3%} (Mitsuba)")
    print(f"{name}: {rejected} of {t.size} beyond the level {level:.1e}; worst t = {t[worst]:.2f}, threshold {threshold:.2f}")
    axes = tuple(range(1, ours.ndim - 1))
    sides = [side.mean(axis=axes) if axes else side for side in (ours, theirs)]
    (a, u), (b, v) = map(mean_and_variance, sides)
    ratios = zip(a / b - 1, numpy.sqrt(u / a**2 + v / b**2))
    print(f"{name}: ours / Mitsuba - 1 by channel: " + ", ".join(f"{ratio:+.4%} ± {error:.4%}" for ratio, error in ratios))
    if max(errors) > arguments.limit:
        print(f"{name}: not known well enough: more --runs or samples")
        return 2
    return 1 if rejected else 0


def arguments_of_command_line():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("steradian", help="the binary")
    parser.add_argument("--runs", type=int, default=12)
    parser.add_argument("--samples", type=int, default=64, help="a pixel and run")
    parser.add_argument("--floor-samples", type=int, default=262144, help="a run")
    parser.add_argument("--false-alarm", type=float, default=0.01, help="of each comparison")
    parser.add_argument("--limit", type=float, default=0.02, help="of the relative standard error of a tile")
    parser.add_argument("--plant", type=float, default=1.0, help="factor on our values")
    return parser.parse_args()


def main():
    arguments = arguments_of_command_line()
    steradian, mitsuba_side = Steradian(arguments.steradian), Mitsuba()
    runs = range(arguments.runs)
    floors = numpy.array([steradian.floor(arguments.floor_samples, seed) for seed in runs])
    theirs = numpy.array([mitsuba_side.floor(arguments.floor_samples, MITSUBA_FIRST_SEED + seed) for seed in runs])
    status = compare("floor", arguments.plant * floors, theirs, arguments)
    pictures = numpy.array([steradian.picture(arguments.samples, seed) for seed in runs])
    theirs = numpy.array([mitsuba_side.picture(arguments.samples, MITSUBA_FIRST_SEED + seed) for seed in runs])
    status = max(status, compare("tiles", tile_means(arguments.plant * pictures), tile_means(theirs), arguments))
    print(["agreement", "disagreement", "not known well enough"][status])
    return status


if __name__ == "__main__":
    sys.exit(main())
