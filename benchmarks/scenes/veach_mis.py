"""Veach's plates: lamps from pin to ball over metal from nearly polished to rough."""

import twin

NAME = "Veach's plates"
SIZE = (128, 128)
DEPTH = 6
SAMPLES = 64
LONG = 64

LAMPS = {
    (-3.75, 0, 0): (0.033333, 901.803),
    (-1.25, 0, 0): (0.1, 100.0),
    (1.25, 0, 0): (0.3, 11.1111),
    (3.75, 0, 0): (0.9, 1.23457),
    (10, 10, 4): (0.5, 800.0),
}
PLATES = {
    0.01: ((-4, -2.70651, 0.25609), (0, 0.62276, -0.782413)),
    0.02: ((-4, -3.28825, 1.36972), (0, 0.44969, -0.893184)),
    0.05: ((-4, -3.73096, 2.70046), (0, 0.29718, -0.95482)),
    0.1: ((-4, -3.99615, 4.0667), (0, 0.17546, -0.98449)),
}


def ours(_folder):
    return twin.HERE / "veach_mis.toml"


def theirs(_folder):
    wall = twin.diffuse(0.4)
    lamps = {
        f"lamp{i}": twin.sphere(center, radius, twin.diffuse(0.0), emitter=twin.area(radiance))
        for i, (center, (radius, radiance)) in enumerate(LAMPS.items())
    }
    plates = {
        f"plate{i}": twin.rectangle(origin, (8, 0, 0), edge, twin.metal(alpha)) for i, (alpha, (origin, edge)) in enumerate(PLATES.items())
    }
    return {
        "type": "scene",
        **lamps,
        **plates,
        "floor": twin.rectangle((-10, -4.14615, 10), (20, 0, 0), (0, 0, -12), wall),
        "wall": twin.rectangle((-10, -4.14615, -2), (20, 0, 0), (0, 14, 0), wall),
        "sensor": twin.camera([0, 2, 15], [0, -2, 2.5], 28, up=[0, 1, 0]),
    }
