"""Glare of three synthetic pictures by Radiance's evalglare.

The pictures are those of `crates/steradian-io/tests/glare_pictures.rs`, which compares with what is printed here; or any
pictures given, for which `steradian glare PICTURE` prints the same figures.

    python evalglare_dgp.py [--bin FOLDER] [PICTURE.hdr ...]

Needs the program `evalglare`: `pip install pyradiance` has it, in pyradiance/bin.
"""

import argparse
import math
import pathlib
import subprocess
import tempfile

SIZE = 160
# Levels in W/(m2 sr), each an exact number of the format: (m + 1/2)/256 * 2^n.
DIM, GREY, BRIGHT, SUN = 160.5 / 256, 200.5 / 128, 224.5 * 2**-3, 150.5 * 2**3


def angle(a, b):
    return math.degrees(math.acos(max(-1.0, min(1.0, sum(x * y for x, y in zip(a, b))))))


def towards(azimuth, elevation):
    """Ahead is x, left is y, up is z; the azimuth is to the left."""
    a, e = math.radians(azimuth), math.radians(elevation)
    return (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))


def window(d):
    """A bright window to the left above a dim floor."""
    azimuth, elevation = math.degrees(math.atan2(d[1], d[0])), math.degrees(math.asin(d[2]))
    if 5 < azimuth < 40 and -5 < elevation < 30:
        return BRIGHT
    return GREY if d[2] > 0 else DIM


def sun(d):
    """The same with a sun in it."""
    return SUN if angle(d, towards(20, 15)) < 3 else window(d)


def lamps(d):
    """Four lamps above, and a bright spot on the desk."""
    places = [(-35, 30), (-12, 25), (12, 25), (35, 30), (10, -35)]
    if any(angle(d, towards(*place)) < 4 for place in places):
        return BRIGHT
    return DIM


PICTURES = {
    "window": (window, "a", lambda r: r * math.pi / 2),
    "sun": (sun, "a", lambda r: r * math.pi / 2),
    "lamps": (lamps, "h", lambda r: math.asin(min(r, 1.0))),
}


def rgbe(value):
    mantissa, exponent = math.frexp(value)
    m = int(mantissa * 256)
    return bytes([m, m, m, exponent + 128])


def picture(name):
    luminance, kind, polar = PICTURES[name]
    header = f"#?RADIANCE\nVIEW= -vt{kind} -vp 0 0 0 -vd 1 0 0 -vu 0 0 1 -vh 180 -vv 180\nFORMAT=32-bit_rle_rgbe\n\n-Y {SIZE} +X {SIZE}\n"
    pixels = []
    for row in range(SIZE):
        for column in range(SIZE):
            right, down = ((2 * place + 1 - SIZE) / SIZE for place in (column, row))
            r = math.hypot(right, down)
            if r > 1:
                pixels.append(bytes(4))
                continue
            theta = polar(r)
            across = math.sin(theta) / max(r, 1e-300)
            pixels.append(rgbe(luminance((math.cos(theta), -right * across, -down * across))))
    return header.encode() + b"".join(pixels)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default="", help="folder of evalglare")
    parser.add_argument("--keep", help="folder for the pictures made here")
    parser.add_argument("pictures", nargs="*")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.bin, "evalglare")) if arguments.bin else "evalglare"
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(arguments.keep or folder)
        paths = [pathlib.Path(path) for path in arguments.pictures]
        for name in [] if paths else PICTURES:
            path = folder / f"{name}.hdr"
            path.write_bytes(picture(name))
            paths.append(path)
        for path in paths:
            found = subprocess.run([program, "-d", str(path)], capture_output=True, text=True, check=True)
            print(path.name)
            print(found.stdout)


if __name__ == "__main__":
    main()
