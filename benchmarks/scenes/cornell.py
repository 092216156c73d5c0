"""The Cornell box of `mitsuba.cornell_box()`, which scenes/cornell-box.toml tells in our language."""

import twin

NAME = "Cornell box"
SIZE = (256, 256)
DEPTH = 8
SAMPLES = 64
LONG = 144
FLOOR = 0.01
CYCLES = "cornell_in_cycles.py"


def ours(_folder):
    return twin.SCENES / "cornell-box.toml"


def theirs(_folder):
    import mitsuba

    return mitsuba.cornell_box()
