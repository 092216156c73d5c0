"""The bumpy geodesic sphere: 20 f² triangles of frequency f, seen from inside. Its vertices are those of the mesh `sphere…` that
the kernel's benchmark traces, up to rounding.

usage: meshes.py FREQUENCY DIRECTORY NAME       writes NAME.verts.f32 and NAME.tris.u32
       meshes.py FREQUENCY DIRECTORY NAME.ply   writes binary PLY
"""

import pathlib
import sys

import numpy

GOLDEN = (1 + 5**0.5) / 2
CORNERS = numpy.array(
    [(-1, GOLDEN, 0), (1, GOLDEN, 0), (-1, -GOLDEN, 0), (1, -GOLDEN, 0), (0, -1, GOLDEN), (0, 1, GOLDEN)]
    + [(0, -1, -GOLDEN), (0, 1, -GOLDEN), (GOLDEN, 0, -1), (GOLDEN, 0, 1), (-GOLDEN, 0, -1), (-GOLDEN, 0, 1)]
) / (1 + GOLDEN**2) ** 0.5
FACES = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8)]
FACES += [(3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]


def bumps(x, y, z):
    """How much a direction's distance exceeds 1."""
    sin = numpy.sin
    return 0.08 * sin(7 * x + 1.3) * sin(9 * y + 0.7) * sin(8 * z + 2.1) + 0.02 * sin(31 * x) * sin(29 * y) * sin(37 * z)


def lattice(frequency):
    """Barycentric indices of a face's vertices, and its triangles as triples of them."""
    rows = numpy.arange(frequency + 1)
    i = numpy.repeat(rows, frequency + 1 - rows)
    j = numpy.concatenate([numpy.arange(frequency + 1 - row) for row in rows])
    number = i * (frequency + 1) - i * (i - 1) // 2 + j
    right, below = number + 1, number + frequency + 1 - i
    upright, reversed_ = i + j < frequency, i + j < frequency - 1
    triangles = numpy.concatenate(
        [
            numpy.stack([number, below, right], axis=1)[upright],
            numpy.stack([below, below + 1, right], axis=1)[reversed_],
        ]
    )
    return i, j, triangles


def sphere(frequency):
    """Vertices (float32) and triangles (uint32); the 20 faces share no vertex."""
    i, j, triangles = lattice(frequency)
    vertices = []
    for a, b, c in FACES:
        points = numpy.outer(frequency - i - j, CORNERS[a]) + numpy.outer(i, CORNERS[b]) + numpy.outer(j, CORNERS[c])
        points /= numpy.linalg.norm(points, axis=1, keepdims=True)
        vertices.append((points * (1 + bumps(*points.T))[:, None]).astype("<f4"))
    every = numpy.concatenate([triangles + face * len(i) for face in range(len(FACES))])
    return numpy.concatenate(vertices), every.astype("<u4")


def write_raw(vertices, triangles, directory, name):
    vertices.tofile(pathlib.Path(directory, f"{name}.verts.f32"))
    triangles.tofile(pathlib.Path(directory, f"{name}.tris.u32"))


def write_ply(vertices, triangles, path):
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    faces = numpy.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<u4", 3)])
    faces["count"], faces["corners"] = 3, triangles
    with open(path, "wb") as file:
        file.write(head.encode())
        vertices.astype("<f4").tofile(file)
        faces.tofile(file)


def main():
    frequency, directory, name = int(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    if name.endswith(".ply"):
        write_ply(*sphere(frequency), directory / name)
    else:
        write_raw(*sphere(frequency), directory, name)


if __name__ == "__main__":
    main()
