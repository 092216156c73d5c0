"""A ball of glass and its caustic."""

import twin

NAME = "Glass ball"
SIZE = (128, 128)
DEPTH = 10
SAMPLES = 64
LONG = 64


def ours(_folder):
    return twin.HERE / "glass_ball.toml"


def theirs(_folder):
    grey, black = twin.diffuse([0.6, 0.55, 0.5]), twin.diffuse(0.0)
    glass = {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}
    return {
        "type": "scene",
        **twin.room((-2, -2, 0), (2, 2, 3), grey, grey, grey),
        "lamp": twin.rectangle((-0.5, -0.5, 2.99), (0, 1, 0), (1, 0, 0), black, emitter=twin.area(10.0)),
        "ball": twin.sphere((0, 0, 0.6), 0.5, glass),
        "sensor": twin.camera([0, -1.9, 1.5], [0, 0, 0.5], 60),
    }
