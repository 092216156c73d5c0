#!/usr/bin/env python3
"""How time and memory grow: with threads, triangles, lamps and sensors; and the peak memory of a picture.

usage: scaling.py --of threads|triangles|lights|sensors|memory [--program STERADIAN] [--kernel BENCH] [--rounds 5] [--quick]

Needs no peer, except that trees of triangles are built by Embree as well and pictures rendered by Mitsuba where they are installed.
"""

import ctypes
import importlib.util
import json
import pathlib
import sys
import tempfile

import measure

SUITE = pathlib.Path(__file__).resolve().parent
CORNELL = measure.REPOSITORY / "scenes" / "cornell-box.toml"
MIB = 2.0**20
BYTES_A_TRIANGLE = 100.0
TWO_THREADS = 1.9


def threads(given):
    """The clock decides here, so a busy machine tells little: the processor time of both is compared as well."""
    samples = 64 if given.quick else 256
    how = f"Cornell box, 256x256, {samples} spp, at most 8 segments, Gaussian σ=½, whole process"
    for round in range(given.rounds):
        one, two = (picture(given.program, number, samples) for number in (1, 2))
        common = {"round": round, "better": "less", "peer": "itself, 1 thread", "how": how}
        measure.figure("2 threads, clock", "s", two.wall_seconds, theirs=one.wall_seconds, goal=TWO_THREADS, **common)
        measure.figure("2 threads, processor", "CPU s", two.cpu_seconds, theirs=one.cpu_seconds, **common)


def picture(program, threads, samples):
    with tempfile.TemporaryDirectory(prefix="steradian-scaling-") as folder:
        command = [program, "render", CORNELL, "--max-depth", 8, "--filter", "gaussian", "--samples", samples]
        return measure.run([*command, "--threads", threads, "-o", pathlib.Path(folder, "picture.pfm")])


def triangles(given):
    frequencies = {"10 thousand": 22, "100 thousand": 71, "1 million": 224} | ({} if given.quick else {"10 million": 707})
    for round in range(given.rounds if given.quick else min(given.rounds, 5)):
        for count, frequency in frequencies.items():
            name = f"bumpy{frequency}"
            if not (given.cache / f"{name}.tris.u32").exists():
                measure.run([sys.executable, SUITE / "meshes.py", frequency, given.cache, name])
            measure.progress(f"triangles: {count}, round {round + 1}")
            built(given, count, name, round)


def built(given, count, name, round):
    """Our tree and Embree's of one mesh."""
    cost = measure.run([given.kernel, given.cache, name, "--build-only"])
    words = dict(line.removeprefix(f"{name} ").split(": ") for line in cost.text().splitlines())
    number = (given.cache / f"{name}.tris.u32").stat().st_size / 12
    common = {"round": round, "better": "less", "how": "bumpy sphere; tree without the mesh; 1 thread"}
    bytes_ = float(words["bytes_per_triangle"])
    goal = {"peer": "the goal", "theirs": BYTES_A_TRIANGLE, "goal": 1.0} if count == "10 million" else {}
    measure.figure(f"{count} triangles, tree", "bytes/triangle", bytes_, **common, **goal)
    how = {"how": "bumpy sphere; whole process, mesh and its file in memory too; 1 thread"}
    measure.figure(f"{count} triangles, peak of a build", "bytes/triangle", cost.peak_bytes / number, **common | goal | how)
    embree = embree_build(given.cache, name)
    peer = {"peer": "Embree, high quality", "theirs": embree["cpu_seconds"]} if embree else {}
    measure.figure(f"{count} triangles, build", "CPU s", float(words["build_s"]), **common, **peer)


def embree_build(folder, name):
    """What benchmarks/embree/memory.py finds; nothing where Embree is not installed."""
    try:
        ctypes.CDLL("libembree3.so.3")
    except OSError:
        return measure.missing("Embree", "apt-get install libembree-dev")
    return json.loads(measure.run([sys.executable, SUITE.parent / "embree" / "memory.py", folder, name]).output)


def lights(given):
    """The hall of benchmarks/many_lights under spots, every one of 400 points to 2 %."""
    specification = importlib.util.spec_from_file_location("hall", SUITE.parent / "many_lights" / "hall.py")
    hall = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(hall)
    how = "hall under spots of the same flux together, 400 points, every 95 % interval within 2 %, 1 thread, whole process"
    with tempfile.TemporaryDirectory(prefix="steradian-scaling-") as folder:
        for round in range(given.rounds):
            first = None
            for count in hall.ROWS:
                measure.progress(f"lights: {count}, round {round + 1}")
                path = pathlib.Path(folder, f"{count}.toml")
                path.write_text(hall.scene(count, "spot"))
                seconds = measured(given, path, "--rel-error", "2%", "--seed", round).cpu_seconds
                first = first or seconds
                beside = {} if count == 10 else {"peer": "itself, 10 lamps", "theirs": first}
                measure.figure(f"{count} lamps", "CPU s", seconds, round=round, better="less", how=how, **beside)


def sensors(given):
    """Time and peak memory by the number of points; sixteen samples each, printed as CSV to a file."""
    counts = {"1 thousand": (40, 25), "10 thousand": (100, 100), "100 thousand": (400, 250)}
    counts |= {} if given.quick else {"1 million": (1000, 1000)}
    box = CORNELL.read_text().split("[[sensors]]")[0]
    how = "points in the middle of the Cornell box, 16 samples each, any number of segments, CSV, 1 thread, whole process"
    with tempfile.TemporaryDirectory(prefix="steradian-scaling-") as folder:
        for round in range(min(given.rounds, 3)):
            before = None
            for count, (rows, columns) in counts.items():
                measure.progress(f"sensors: {count}, round {round + 1}")
                path = pathlib.Path(folder, "sensors.toml")
                plane = f"grid = {{ origin = [-1, 0.5, 1], edges = [[2, 0, 0], [0, 0, -2]], count = [{rows}, {columns}] }}"
                path.write_text(f'{box}[[sensors]]\nname = "points"\nkind = "irradiance"\n{plane}\n')
                cost = measured(given, path, "--samples", 16, "--seed", round)
                common = {"round": round, "better": "less", "how": how}
                beside = {"peer": "itself, a tenth as many", "theirs": before and before.peak_bytes / MIB}
                goal = {"goal": 0.5} if count == "1 million" else {}
                measure.figure(f"{count} sensors, peak", "MiB", cost.peak_bytes / MIB, **common, **(beside if before else {}), **goal)
                measure.figure(f"{count} sensors, time", "CPU µs a sensor", cost.cpu_seconds / rows / columns * 1e6, **common)
                before = cost


def measured(given, scene, *options):
    command = [given.program, "measure", scene, *options, "--threads", 1, "--format", "csv"]
    return measure.run([*command, "-o", scene.with_suffix(".csv")], accept=(0, 1))


def memory(given):
    """Peak of a whole process that renders one picture."""
    how = "Cornell box, 256x256, 16 spp, at most 8 segments, Gaussian σ=½, 1 thread, whole process"
    for round in range(given.rounds):
        ours = picture(given.program, 1, 16).peak_bytes / MIB
        theirs = mitsuba_peak()
        peer = {"peer": "Mitsuba llvm_ad_rgb, Python included", "theirs": theirs} if theirs else {}
        measure.figure("Cornell box, peak", "MiB", ours, round=round, better="less", how=how, **peer)


RENDER = """
import sys, mitsuba, drjit
mitsuba.set_variant("llvm_ad_rgb")
drjit.set_thread_count(1)
scene = mitsuba.cornell_box()
scene["integrator"]["max_depth"] = 8
scene["sensor"]["film"].update(width=256, height=256)
drjit.eval(mitsuba.render(mitsuba.load_dict(scene), spp=16))
drjit.sync_thread()
"""


def mitsuba_peak():
    if not importlib.util.find_spec("mitsuba"):
        return measure.missing("Mitsuba", "python3 -m venv venv && venv/bin/pip install mitsuba numpy, and give venv/bin/python by --mitsuba")
    return measure.run([sys.executable, "-c", RENDER]).peak_bytes / MIB


PARTS = {"threads": threads, "triangles": triangles, "lights": lights, "sensors": sensors, "memory": memory}


def main():
    given = measure.options(__doc__, of={"required": True, "choices": PARTS}, kernel={})
    PARTS[given.of](given)


if __name__ == "__main__":
    main()
