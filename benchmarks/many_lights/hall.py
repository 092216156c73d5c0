"""A hall of 40 m x 40 m x 6 m with racks, lit by many lamps of the same flux together, and 400 points on its floor."""

import pathlib

HEAD = """[scene]
name = "Hall with {count} lamps"
spectrum = "broadband"

[materials]
white = {{ model = "lambertian", reflectance = 0.7 }}
grey = {{ model = "lambertian", reflectance = 0.5 }}
dark = {{ model = "lambertian", reflectance = 0.2 }}

[[shapes]]
kind = "box"
min = [0, 0, 0]
max = [40, 40, 6]
inside = true
material = "grey"
faces = {{ floor = "dark", ceiling = "white" }}

[[sensors]]
name = "floor"
kind = "illuminance"
grid = {{ origin = [0, 0, 0.02], edges = [[40, 0, 0], [0, 40, 0]], count = [20, 20] }}
"""

RACK = """
[[shapes]]
kind = "box"
min = [{x}, 4, 0]
max = [{x1}, 36, 4]
material = "grey"
"""

# A recessed luminaire of 53 cm x 53 cm.
LUMINAIRE = pathlib.Path(__file__).parents[2].resolve() / "tests/data/photometry/lum_sample_01.ldt"

LAMPS = {
    "point": 'kind = "point"\nposition = [{x}, {y}, 5.5]\nflux = "{lumens} lm"',
    "spot": 'kind = "spot"\nposition = [{x}, {y}, 5.5]\ndirection = [0, 0, -1]\ncutoff = "60 deg"\nflux = "{lumens} lm"',
    "panel": 'kind = "rectangle"\norigin = [{x}, {y}, 5.5]\nedges = [[0, 0.1, 0], [0.1, 0, 0]]\nemission = {{ flux = "{lumens} lm" }}',
    "luminaire": f'kind = "luminaire"\nfile = "{LUMINAIRE}"\nemit = "point"\nposition = [{{x}}, {{y}}, 5.5]\nflux = "{{lumens}} lm"',
}

# Rows and columns of lamps.
ROWS = {10: (2, 5), 100: (10, 10), 1000: (25, 40), 10000: (100, 100)}

TOTAL_LUMENS = 1e6


def scene(count, kind):
    """The scene as TOML."""
    rows, columns = ROWS[count]
    table = "shapes" if kind == "panel" else "lights"
    parts = [HEAD.format(count=count)]
    # Narrower than the gaps between points, so that no point lies within one.
    parts += [RACK.format(x=x, x1=x + 0.8) for x in (7.6, 15.6, 23.6, 31.6)]
    for k in range(count):
        x, y = 40 * (k % columns + 0.5) / columns, 40 * (k // columns + 0.5) / rows
        lamp = LAMPS[kind].format(x=f"{x:.6g}", y=f"{y:.6g}", lumens=f"{TOTAL_LUMENS / count:.6g}")
        parts.append(f"\n[[{table}]]\n{lamp}\n")
    return "".join(parts)
