"""A room lit by an even sky through an opening."""

import twin

NAME = "Room under the sky"
SIZE = (128, 128)
DEPTH = 8
SAMPLES = 64
LONG = 64


def ours(_folder):
    return twin.HERE / "sky_room.toml"


def theirs(_folder):
    white, floor = twin.diffuse(0.7), twin.diffuse([0.45, 0.33, 0.22])
    room = twin.room((0, 0, 0), (4, 5, 2.6), floor, white, white)
    del room["back"]
    up = (0, 0, 2.6)
    return {
        "type": "scene",
        **room,
        "left of the opening": twin.rectangle((0, 5, 0), (0.5, 0, 0), up, white),
        "right of it": twin.rectangle((3.5, 5, 0), (0.5, 0, 0), up, white),
        "below it": twin.rectangle((0.5, 5, 0), (3, 0, 0), (0, 0, 0.9), white),
        "above it": twin.rectangle((0.5, 5, 2.3), (3, 0, 0), (0, 0, 0.3), white),
        "block": twin.box((2.3, 2.6, 0), (2.9, 3.2, 0.7), white),
        "sky": {"type": "constant", "radiance": twin.rgb(1.0)},
        "sensor": twin.camera([2, 0.3, 1.5], [2, 5, 0.9], 70),
    }
