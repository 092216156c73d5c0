#!/usr/bin/env python3
"""Renders every glTF, OBJ, PLY and STL file of some folders small and puts the pictures on one sheet.

    contact_sheet.py FOLDER… SHEET.png [--program steradian] [--width 240] [--height 180] [--samples 32]

Prints a line for each file: seconds, the largest memory in MiB, and what the program warned of.
Pictures stand in rows of seven, in the order of the printed lines. Standard library only.
"""

import argparse
import pathlib
import resource
import struct
import subprocess
import tempfile
import time
import zlib

COLUMNS = 7
SUFFIXES = (".gltf", ".glb", ".obj", ".ply", ".stl")


def decode(png: bytes) -> tuple[int, int, list[bytes]]:
    """Width, height and the rows of an 8-bit RGB picture."""
    width, height, depth, color = struct.unpack(">IIBB", png[16:26])
    assert (depth, color) == (8, 2), (depth, color)
    data, at = b"", 8
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        if png[at + 4 : at + 8] == b"IDAT":
            data += png[at + 8 : at + 8 + length]
        at += length + 12
    raw, stride, rows = zlib.decompress(data), 3 * width, []
    above = bytes(stride)
    for y in range(height):
        kind, *line = raw[y * (stride + 1) : (y + 1) * (stride + 1)]
        above = unfilter(kind, line, above)
        rows.append(above)
    return width, height, rows


def unfilter(kind: int, line: list[int], above: bytes) -> bytes:
    for x in range(len(line)):
        left = line[x - 3] if x >= 3 else 0
        corner = above[x - 3] if x >= 3 else 0
        line[x] = (line[x] + predicted(kind, left, above[x], corner)) & 255
    return bytes(line)


def predicted(kind: int, left: int, up: int, corner: int) -> int:
    if kind == 4:
        guess = left + up - corner
        return min((left, up, corner), key=lambda near: abs(guess - near))
    return (0, left, up, (left + up) // 2)[kind]


def encode(width: int, rows: list[bytes]) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        crc = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", crc)

    header = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def sheet(pictures: list[list[bytes]], width: int, height: int) -> bytes:
    black = [bytes(3 * width)] * height
    pictures = pictures + [black] * (-len(pictures) % COLUMNS)
    rows = []
    for start in range(0, len(pictures), COLUMNS):
        rows += [b"".join(line) for line in zip(*pictures[start : start + COLUMNS])]
    return encode(width * COLUMNS, rows)


def render(program: str, scene: pathlib.Path, picture: pathlib.Path, options) -> list[bytes]:
    size = f"{options.width}x{options.height}"
    command = [program, "render", str(scene), "-o", str(picture), "--resolution", size]
    command += ["--samples", str(options.samples)]
    start = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    seconds = time.monotonic() - start
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{scene.name}: status {done.returncode}, {seconds:.1f} s, at most {memory:.0f} MiB so far")
    for line in (done.stdout + done.stderr).splitlines():
        print(f"    {line}")
    if not picture.exists():
        return [b"\xff\0\0" * options.width] * options.height
    return decode(picture.read_bytes())[2]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("sheet", type=pathlib.Path)
    parser.add_argument("--program", default="steradian")
    parser.add_argument("--width", type=int, default=240)
    parser.add_argument("--height", type=int, default=180)
    parser.add_argument("--samples", type=int, default=32)
    options = parser.parse_args()
    files = (path for folder in options.folders for path in sorted(folder.rglob("*")))
    scenes = [path for path in files if path.suffix.lower() in SUFFIXES]
    pictures = []
    with tempfile.TemporaryDirectory() as folder:
        for number, scene in enumerate(scenes):
            picture = pathlib.Path(folder) / f"{number}.png"
            pictures.append(render(options.program, scene, picture, options))
    options.sheet.write_bytes(sheet(pictures, options.width, options.height))


if __name__ == "__main__":
    main()
