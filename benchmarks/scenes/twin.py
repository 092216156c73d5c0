"""What the scenes of the suite share: the words of Mitsuba's dictionaries for the shapes and materials of our scene language.

A scene is a module with NAME, SIZE in pixels, DEPTH (most segments of a path), SAMPLES a pixel of a timed picture, LONG samples a
pixel of each of the reference pictures, `ours(folder)`, which returns the path of our scene file, and `theirs(folder)`, which returns the dictionary that
`mitsuba.load_dict` wants, without integrator, film and sampler. Lengths are metres, z points up.
"""

import pathlib
import sys

import numpy

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parents[1] / "scenes"

sys.path.append(str(HERE.parent / "suite"))
from meshes import write_ply  # noqa: E402, F401

ETA, K = [1.65746, 0.880369, 0.521229], [9.22387, 6.26952, 4.837]
OUR_METAL = f'model = "rough-conductor"\neta = {ETA}\nk = {K}\nalpha = {{alpha}}\nmultiple_scattering = false\nshadowing = "separable"'




def rgb(values):
    return {"type": "rgb", "value": values if isinstance(values, list) else [values] * 3}


def transform(matrix):
    import mitsuba

    return mitsuba.ScalarTransform4f(matrix)


def diffuse(values):
    """Two-sided, as our materials are."""
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(values)}}


def metal(alpha):
    """Rough aluminium; OUR_METAL is the same."""
    return {"type": "twosided", "bsdf": {"type": "roughconductor", "distribution": "ggx", "alpha": alpha, "eta": rgb(ETA), "k": rgb(K)}}


def area(radiance):
    return {"type": "area", "radiance": rgb(radiance)}


def rectangle(origin, first, second, bsdf, **more):
    """A corner and two edges; the normal is the first × the second. Mitsuba's is [-1, 1]² with the normal along z."""
    origin, first, second = (numpy.array(vector, float) for vector in (origin, first, second))
    normal = numpy.cross(first, second)
    matrix = numpy.eye(4)
    columns = (first / 2, second / 2, normal / numpy.linalg.norm(normal), origin + first / 2 + second / 2)
    matrix[:3] = numpy.stack(columns, axis=1)
    return {"type": "rectangle", "to_world": transform(matrix), "bsdf": bsdf, **more}


def box(least, greatest, bsdf):
    """A box along the axes; Mitsuba's is [-1, 1]³."""
    least, greatest = numpy.array(least, float), numpy.array(greatest, float)
    matrix = numpy.diag([*(greatest - least) / 2, 1.0])
    matrix[:3, 3] = (least + greatest) / 2
    return {"type": "cube", "to_world": transform(matrix), "bsdf": bsdf}


def room(least, greatest, floor, ceiling, walls):
    """The six faces of a box seen from inside."""
    (x0, y0, z0), (x1, y1, z1) = least, greatest
    x, y, z = (x1 - x0, 0, 0), (0, y1 - y0, 0), (0, 0, z1 - z0)
    return {
        "floor": rectangle(least, x, y, floor),
        "ceiling": rectangle((x0, y0, z1), y, x, ceiling),
        "left": rectangle(least, y, z, walls),
        "right": rectangle((x1, y0, z0), z, y, walls),
        "front": rectangle(least, z, x, walls),
        "back": rectangle((x0, y1, z0), x, z, walls),
    }


def sphere(center, radius, bsdf, **more):
    return {"type": "sphere", "center": list(center), "radius": radius, "bsdf": bsdf, **more}


def camera(position, look_at, fov, up=(0, 0, 1)):
    """`fov` in degrees across the width."""
    import mitsuba

    to_world = mitsuba.ScalarTransform4f().look_at(origin=position, target=look_at, up=list(up))
    return {"type": "perspective", "fov": fov, "fov_axis": "x", "to_world": to_world}
