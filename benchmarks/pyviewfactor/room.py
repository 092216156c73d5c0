"""Writes a room with a box in it as an OBJ file of square facets: python3 room.py N > room.obj

The room measures 4 m x 3 m x 3 m and faces inwards; the box of 1 m x 1 m x 1 m floats in it, off every wall, and faces outwards. Both are
cut into squares of 1/N m, so that there are (66 + 6) N^2 facets."""

import sys


def face(corner, u, v, counts, n):
    """Squares of a rectangle that faces along u x v, as corners."""
    step = lambda i, j: tuple(c + (a * i + b * j) / n for c, a, b in zip(corner, u, v))
    for i in range(counts[0] * n):
        for j in range(counts[1] * n):
            yield [step(i, j), step(i + 1, j), step(i + 1, j + 1), step(i, j + 1)]


def cuboid(low, size, n, inside):
    """All squares of a box."""
    for axis in range(3):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        u = [float(k == a) for k in range(3)]
        v = [float(k == b) for k in range(3)]
        for far in (False, True):
            corner = list(low)
            corner[axis] += size[axis] * far
            for square in face(corner, u, v, (size[a], size[b]), n):
                # u x v points along the axis: outwards on the far side.
                yield square if far != inside else square[::-1]


def squares(n):
    yield from cuboid((0.0, 0.0, 0.0), (4, 3, 3), n, True)
    yield from cuboid((1.3, 0.9, 0.7), (1, 1, 1), n, False)


if __name__ == "__main__":
    number = 1
    for square in squares(int(sys.argv[1])):
        for x, y, z in square:
            print(f"v {x:.12g} {y:.12g} {z:.12g}")
        print("f", *range(number, number + 4))
        number += 4
