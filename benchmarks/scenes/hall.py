"""A hall of 40 m x 40 m under 1 000 square panels, as benchmarks/many_lights/hall.py makes it, with a camera in a corner."""

import importlib.util
import re

import twin

NAME = "Hall under 1 000 panels"
SIZE = (128, 128)
DEPTH = 6
SAMPLES = 64
LONG = 64

ROWS, COLUMNS, RADIANCE = 25, 40, 100.0
POSITION, LOOK_AT, FOV = [1.0, 1.0, 5.0], [25.0, 25.0, 0.5], 80
CAMERA = f"""
[[sensors]]
name = "camera"
kind = "camera"
position = {POSITION}
look_at = {LOOK_AT}
fov = "{FOV} deg"
resolution = {list(SIZE)}
"""


def text():
    """The scene of the benchmark of many lamps, in colours and watts."""
    specification = importlib.util.spec_from_file_location("many_lights", twin.HERE.parent / "many_lights" / "hall.py")
    many_lights = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(many_lights)
    grey = many_lights.scene(ROWS * COLUMNS, "panel").replace('"broadband"', '"rgb"')
    return re.sub(r'flux = "[^"]*"', f'radiance = "{RADIANCE} W/(m2 sr)"', grey) + CAMERA


def ours(folder):
    path = folder / "hall.toml"
    path.write_text(text())
    return path


def panel(number):
    x, y = 40 * (number % COLUMNS + 0.5) / COLUMNS, 40 * (number // COLUMNS + 0.5) / ROWS
    return twin.rectangle((x, y, 5.5), (0, 0.1, 0), (0.1, 0, 0), twin.diffuse(0.0), emitter=twin.area(RADIANCE))


def theirs(_folder):
    dark, grey, white = (twin.diffuse(reflectance) for reflectance in (0.2, 0.5, 0.7))
    racks = {f"rack at {x:.0f} m": twin.box((x, 4, 0), (x + 0.8, 36, 4), grey) for x in (7.6, 15.6, 23.6, 31.6)}
    return {
        "type": "scene",
        **twin.room((0, 0, 0), (40, 40, 6), dark, white, grey),
        **racks,
        **{f"panel{number}": panel(number) for number in range(ROWS * COLUMNS)},
        "sensor": twin.camera(POSITION, LOOK_AT, FOV),
    }
