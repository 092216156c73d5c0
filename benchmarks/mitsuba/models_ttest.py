#!/usr/bin/env python3
"""Test whether Steradian's reflection models agree with Mitsuba's, each in a small studio, tile by tile.

usage: models_ttest.py STERADIAN [--only NAME ...] [--runs 16] [--samples 256] [--plant 1.02]

A body of the model, a sphere or a leaning panel, stands on a grey floor before a grey wall, under a small square light
and a luminous ceiling. There is no constant sky: Mitsuba 3.9.1's shadow rays towards one are not stopped by these walls,
which makes its picture .6 % too bright; sampled by the surfaces alone it agrees. The models are those that both programs
define alike, with one reflection by facets: ours lose light between facets on request (`multiple_scattering = false`) and
shadow them separably, as Mitsuba does.

The base of the rough plastic is dark: Mitsuba's mean reflectance of its coat from inside, .4504 for this one, is an average over 64
equidistant cosines with both ends in full, 1.4 % below the integral (.4568), which a base of reflectance .7 shows as .5 %.

The means of every tile of 24 x 24 pixels and every channel over independent runs are compared by Welch's t (see
cornell_ttest.py). If all tiles of all models agree, the chance of a false alarm is at most `--false-alarm` (Sidak). Every
standard error must be within `--limit` of the tile's mean. `--plant 1.02` makes our pictures 2 % too bright, which every
model must fail.

exit status: 0 agreement, 1 disagreement, 2 the tiles are not known well enough
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import typing

import drjit
import mitsuba
import numpy
from scipy import stats

from cornell import read_pfm
from cornell_ttest import welch, worst_relative_error

SIZE, TILE, DEPTH = 96, 24, 12
MITSUBA_FIRST_SEED = 1000
# Gold, roughly: the numbers only have to be the same.
ETA, K = [0.14, 0.37, 1.44], [4.0, 2.4, 1.6]
LIGHT = [12.0, 10.0, 8.0]
LUMINANCE = 0.2126 * LIGHT[0] + 0.7152 * LIGHT[1] + 0.0722 * LIGHT[2]


def rgb(values):
    return {"type": "rgb", "value": values}


def diffuse(values):
    return {"type": "diffuse", "reflectance": rgb(values)}


class Model(typing.NamedTuple):
    body: str
    ours: str
    """The tables of our scene file; the body's material is called `body`."""
    theirs: dict


FACETS = 'multiple_scattering = false\nshadowing = "separable"\n'

MODELS = {
    "diffuse": Model("sphere", '[materials.body]\nmodel = "lambertian"\nreflectance = [0.8, 0.5, 0.2]', diffuse([0.8, 0.5, 0.2])),
    "conductor": Model(
        "sphere",
        f'[materials.body]\nmodel = "conductor"\neta = {ETA}\nk = {K}',
        {"type": "conductor", "eta": rgb(ETA), "k": rgb(K)},
    ),
    "rough conductor, GGX .2": Model(
        "sphere",
        f'[materials.body]\nmodel = "rough-conductor"\neta = {ETA}\nk = {K}\nalpha = 0.2\n{FACETS}',
        {"type": "roughconductor", "distribution": "ggx", "alpha": 0.2, "eta": rgb(ETA), "k": rgb(K)},
    ),
    "rough conductor, Beckmann .15 x .4": Model(
        "panel",
        f'[materials.body]\nmodel = "rough-conductor"\neta = {ETA}\nk = {K}\nalpha_x = 0.15\nalpha_y = 0.4\ndistribution = "beckmann"\n{FACETS}',
        {
            "type": "twosided",
            "bsdf": {"type": "roughconductor", "distribution": "beckmann", "alpha_u": 0.15, "alpha_v": 0.4, "eta": rgb(ETA), "k": rgb(K)},
        },
    ),
    "dielectric": Model("sphere", '[materials.body]\nmodel = "dielectric"\nior = 1.5', {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}),
    "rough dielectric, GGX .3": Model(
        "sphere",
        f'[materials.body]\nmodel = "rough-dielectric"\nior = 1.5\nalpha = 0.3\n{FACETS}',
        {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.3, "int_ior": 1.5, "ext_ior": 1.0},
    ),
    "plastic": Model(
        "sphere",
        '[materials.body]\nmodel = "plastic"\nior = 1.5\ndiffuse = [0.7, 0.4, 0.1]',
        {"type": "plastic", "int_ior": 1.5, "ext_ior": 1.0, "diffuse_reflectance": rgb([0.7, 0.4, 0.1]), "nonlinear": True},
    ),
    "rough plastic, GGX .25": Model(
        "sphere",
        f'[materials.body]\nmodel = "rough-plastic"\nior = 1.5\ndiffuse = [0.2, 0.1, 0.05]\nalpha = 0.25\n{FACETS}',
        {
            "type": "roughplastic",
            "distribution": "ggx",
            "alpha": 0.25,
            "int_ior": 1.5,
            "ext_ior": 1.0,
            "diffuse_reflectance": rgb([0.2, 0.1, 0.05]),
            "nonlinear": True,
        },
    ),
    "mixture": Model(
        "sphere",
        '[materials.a]\nmodel = "lambertian"\nreflectance = [0.8, 0.5, 0.2]\n'
        f'[materials.b]\nmodel = "rough-conductor"\neta = {ETA}\nk = {K}\nalpha = 0.2\n{FACETS}'
        '[materials.body]\nmodel = "mixture"\nof = ["a", "b"]\nweights = [0.7, 0.3]',
        {
            "type": "blendbsdf",
            "weight": 0.3,
            "a": diffuse([0.8, 0.5, 0.2]),
            "b": {"type": "roughconductor", "distribution": "ggx", "alpha": 0.2, "eta": rgb(ETA), "k": rgb(K)},
        },
    ),
    "mask": Model(
        "panel",
        '[materials.body]\nmodel = "lambertian"\nreflectance = [0.8, 0.5, 0.2]\nopacity = 0.4',
        {"type": "mask", "opacity": 0.4, "bsdf": {"type": "twosided", "bsdf": diffuse([0.8, 0.5, 0.2])}},
    ),
}

STUDIO = f"""
[scene]
spectrum = "rgb"

{{materials}}

[materials.grey]
model = "lambertian"
reflectance = 0.5

[materials.black]
model = "lambertian"
reflectance = 0

[[shapes]]
kind = "rectangle"
origin = [-6, -8, 0]
edges = [[12, 0, 0], [0, 11, 0]]
material = "grey"

[[shapes]]
kind = "rectangle"
origin = [-6, 3, 0]
edges = [[12, 0, 0], [0, 0, 8]]
material = "grey"

[[shapes]]
kind = "rectangle"
origin = [-2, 0, 5]
edges = [[0, 2, 0], [2, 0, 0]]
material = "black"
emission = {{{{ radiance = "{LUMINANCE!r} W/(m2 sr)", spectrum = {LIGHT} }}}}

[[shapes]]
{{body}}
material = "body"

[[shapes]]
kind = "rectangle"
origin = [-6, -8, 8]
edges = [[0, 11, 0], [12, 0, 0]]
material = "black"
emission = {{{{ radiance = "0.4 W/(m2 sr)" }}}}

[[sensors]]
name = "camera"
kind = "camera"
position = [0, -7, 2.5]
look_at = [0, 0, 0.9]
fov = "30 deg"
resolution = [{SIZE}, {SIZE}]
"""

BODIES = {
    "sphere": 'kind = "sphere"\ncenter = [0, 0, 1]\nradius = 1',
    "panel": 'kind = "rectangle"\norigin = [-1.2, -0.5, 0.1]\nedges = [[2.4, 0, 0], [0, 1, 1.8]]',
}


def rectangle(origin, first, second, bsdf, **more):
    """Mitsuba's rectangle is [-1, 1]^2 with the normal along z."""
    origin, first, second = map(numpy.array, (origin, first, second))
    normal = numpy.cross(first, second)
    matrix = numpy.eye(4)
    columns = (first / 2, second / 2, normal / numpy.linalg.norm(normal), origin + first / 2 + second / 2)
    matrix[:3] = numpy.stack(columns, axis=1)
    return {"type": "rectangle", "to_world": mitsuba.ScalarTransform4f(matrix), "bsdf": bsdf, **more}


class Steradian:
    def __init__(self, program, model):
        self.program, self.scene = str(program), STUDIO.format(materials=model.ours, body=BODIES[model.body])

    def render(self, samples, seed):
        with tempfile.TemporaryDirectory(prefix="steradian-models-") as directory:
            scene, output = pathlib.Path(directory, "scene.toml"), pathlib.Path(directory, "picture.pfm")
            scene.write_text(self.scene)
            command = [self.program, "render", scene, "-o", output, "--samples", samples, "--seed", seed]
            command += ["--max-depth", DEPTH, "--filter", "box"]
            subprocess.run([*map(str, command)], check=True, stdout=subprocess.DEVNULL)
            return read_pfm(output)


class Mitsuba:
    def __init__(self, model):
        grey, black = {"type": "twosided", "bsdf": diffuse([0.5] * 3)}, {"type": "twosided", "bsdf": diffuse([0.0] * 3)}
        if model.body == "sphere":
            body = {"type": "sphere", "center": [0, 0, 1], "radius": 1.0, "bsdf": model.theirs}
        else:
            body = rectangle([-1.2, -0.5, 0.1], [2.4, 0, 0], [0, 1, 1.8], model.theirs)
        self.scene = mitsuba.load_dict(
            {
                "type": "scene",
                "integrator": {"type": "path", "max_depth": DEPTH, "rr_depth": DEPTH},
                "floor": rectangle([-6, -8, 0], [12, 0, 0], [0, 11, 0], grey),
                "wall": rectangle([-6, 3, 0], [12, 0, 0], [0, 0, 8], grey),
                "light": rectangle([-2, 0, 5], [0, 2, 0], [2, 0, 0], black, emitter={"type": "area", "radiance": rgb(LIGHT)}),
                "ceiling": rectangle([-6, -8, 8], [0, 11, 0], [12, 0, 0], black, emitter={"type": "area", "radiance": rgb([0.4] * 3)}),
                "body": body,
                "sensor": {
                    "type": "perspective",
                    "fov": 30.0,
                    "to_world": mitsuba.ScalarTransform4f().look_at(origin=[0, -7, 2.5], target=[0, 0, 0.9], up=[0, 0, 1]),
                    "film": {"type": "hdrfilm", "width": SIZE, "height": SIZE, "rfilter": {"type": "box"}, "pixel_format": "rgb"},
                    "sampler": {"type": "independent"},
                },
            }
        )

    def render(self, samples, seed):
        return numpy.array(mitsuba.render(self.scene, spp=samples, seed=seed))[..., :3].astype(float)


def tile_means(pictures):
    runs, count = len(pictures), SIZE // TILE
    return numpy.array(pictures).reshape(runs, count, TILE, count, TILE, 3).mean(axis=(2, 4))


def compare(name, ours, theirs, level, limit):
    """Prints one line; returns the exit status."""
    t, _, p = welch(ours, theirs)
    errors = worst_relative_error(ours), worst_relative_error(theirs)
    beyond = numpy.count_nonzero(p < level)
    whole = [side.mean(axis=(1, 2, 3)) for side in (ours, theirs)]
    ratio = whole[0].mean() / whole[1].mean() - 1
    error = numpy.hypot(*(stats.sem(side) / side.mean() for side in whole))
    status = 2 if max(errors) > limit else int(beyond > 0)
    verdict = ("agreement", "disagreement", "not known well enough")[status]
    print(
        f"{name:36} worst |t| {numpy.abs(t).max():6.2f}, beyond {beyond:2} of {t.size}, tile errors {errors[0]:.2%} and "
        f"{errors[1]:.2%}, picture {ratio:+.3%} ± {error:.3%}: {verdict}",
        flush=True,
    )
    return status


def arguments_of_command_line():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("steradian", help="the binary")
    parser.add_argument("--only", nargs="+", choices=MODELS, default=list(MODELS), metavar="NAME")
    parser.add_argument("--runs", type=int, default=16)
    parser.add_argument("--samples", type=int, default=256, help="a pixel and run")
    parser.add_argument("--false-alarm", type=float, default=0.01)
    parser.add_argument("--limit", type=float, default=0.005, help="of the relative standard error of a tile")
    parser.add_argument("--plant", type=float, default=1.0, help="factor on our pictures")
    return parser.parse_args()


def main():
    arguments = arguments_of_command_line()
    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(1)
    tests = len(arguments.only) * (SIZE // TILE) ** 2 * 3
    level = 1 - (1 - arguments.false_alarm) ** (1 / tests)
    worst = 0
    for name in arguments.only:
        steradian, peer = Steradian(arguments.steradian, MODELS[name]), Mitsuba(MODELS[name])
        ours = [arguments.plant * steradian.render(arguments.samples, seed) for seed in range(arguments.runs)]
        theirs = [peer.render(arguments.samples, MITSUBA_FIRST_SEED + seed) for seed in range(arguments.runs)]
        worst = max(worst, compare(name, tile_means(ours), tile_means(theirs), level, arguments.limit))
    return worst


if __name__ == "__main__":
    sys.exit(main())
