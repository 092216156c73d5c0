"""Pictures as portable float maps."""

import numpy


def read_pfm(path):
    """A colour PFM: its rows come bottom first; a negative scale says little-endian."""
    with open(path, "rb") as file:
        kind, size, scale = file.readline().strip(), file.readline().split(), float(file.readline())
        if kind != b"PF":
            raise ValueError(f"{path}: a colour PFM begins with PF, not {kind!r}")
        width, height = map(int, size)
        floats = numpy.frombuffer(file.read(), "<f4" if scale < 0 else ">f4")
    return floats.reshape(height, width, 3)[::-1].astype(float)
