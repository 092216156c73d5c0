#!/usr/bin/env python3
"""Rays per second, build time and memory of the ray kernel, beside Embree on the same meshes and the same rays.

usage: kernel.py --kernel BENCH [--embree embree_rays.c] [--rounds 5] [--quick]

BENCH is the executable of `cargo bench -p steradian-benches --bench kernel_embree --no-run`. What embree_rays.c must print and
write is told in benchmarks/embree/README.md; without it nothing can be measured, for it also makes the meshes and rays.

In each round both programs trace the same rays on one thread, one after the other, in thread processor time. The figure of a
round is the fastest tenth of a second of half a second of passes on our side, the fastest of three passes on Embree's. Embree is asked one ray at a time, in streams of 1024, and in packets of 8 and
16; its trees are those of RTC_BUILD_QUALITY_HIGH.
"""

import json
import pathlib
import re
import sys

import measure

MESHES = {
    "sphere10k": ["sphere", 22],
    "sphere100k": ["sphere", 71],
    "sphere1M": ["sphere", 224],
    "room10k": ["room", 64, 4, 12345],
    "room100k": ["room", 200, 7, 12345],
    "room1M": ["room", 1000, 10, 12345],
}
# What is traced, what it is called, and the goal against one ray at a time and against Embree's best way.
RAYS = {
    ("primary", "closest"): ("coherent rays, closest hit", None, 0.8),
    ("diffuse", "closest"): ("diffuse bounces, closest hit", 1.0, None),
    ("shadow", "anyhit"): ("shadow rays, any hit", 1.0, None),
}
SPEED = re.compile(r"^\S+ (primary|diffuse|shadow) (closest|anyhit)_(\w+) Mrays_per_s: (\S+)", re.M)
MEMORY = pathlib.Path(__file__).parents[1] / "embree" / "memory.py"
INSTALL = "apt-get install libembree-dev, and give the C program of benchmarks/embree/README.md by --embree"


def speeds(text):
    """Mrays/s by (rays, query), then by way of asking."""
    found = {}
    for rays, query, way, speed in SPEED.findall(text):
        found.setdefault((rays, query), {})[way] = float(speed)
    return found


def number(text, name):
    return float(re.search(rf"{name}: (\S+)", text).group(1))


def embree_version(text):
    """Embree's own number: 31305 is 3.13.5."""
    whole = int(number(text, "embree_version"))
    return f"{whole // 10000}.{whole // 100 % 100}.{whole % 100}"


class Embree:
    def __init__(self, source, folder, resolution):
        self.program, self.folder, self.resolution = folder / "embree_rays", folder, resolution
        measure.run(["gcc", "-O3", "-march=native", "-o", self.program, source, "-lembree3", "-lm"])

    def trace(self, mesh):
        """Also leaves the mesh and its rays under its name."""
        kind, *numbers = MESHES[mesh]
        text = measure.run([self.program, kind, *numbers, self.resolution, 3, self.folder]).text()
        for file in self.folder.glob(f"{kind}.*"):
            file.replace(self.folder / file.name.replace(kind, mesh, 1))
        return text

    def memory(self, mesh):
        return json.loads(measure.run([sys.executable, MEMORY, self.folder, mesh]).output)


def rays(mesh, ours, theirs, how, version, round):
    our_speeds, their_speeds = speeds(ours), speeds(theirs)
    for (kind, query), (name, single_goal, best_goal) in RAYS.items():
        mine, ways = our_speeds[kind, query]["single"], their_speeds[kind, query]
        best = max(ways, key=ways.get)
        for way, label, goal in (("single", "single ray", single_goal), (best, "best way", best_goal)):
            measure.figure(f"{mesh}, {name}", "Mrays/s", mine, round=round, peer=f"Embree {version}, {label}", theirs=ways[way], goal=goal, how=how)


def trees(mesh, ours, theirs, memory, version, round):
    peer = f"Embree {version}, high quality"
    build, bytes_ = number(ours, "build_s"), number(ours, "bytes_per_triangle")
    measure.figure(f"{mesh}, build", "CPU s", build, round=round, peer=peer, theirs=number(theirs, "build_high_s"), better="less", how="one thread")
    if memory:
        theirs = memory["bytes"] / memory["triangles"]
        measure.figure(f"{mesh}, tree", "bytes/triangle", bytes_, round=round, peer=peer, theirs=theirs, better="less", how="finished tree, mesh not counted")


def main():
    given = measure.options(__doc__, kernel={"required": True}, embree={"type": pathlib.Path})
    if not given.embree:
        return measure.missing("Embree", INSTALL)
    resolution = 256 if given.quick else 512
    embree = Embree(given.embree, given.cache, resolution)
    how = f"{resolution}² rays, one thread; ours: fastest tenth of a second of ½ s, Embree: fastest of 3 passes; best way: the fastest of single ray, stream of 1024, packets of 8 and 16"
    meshes = [name for name in MESHES if not given.quick or name.endswith("100k")]
    for round in range(given.rounds):
        for mesh in meshes:
            measure.progress(f"kernel: {mesh}, round {round + 1} of {given.rounds}")
            theirs = embree.trace(mesh)
            ours = measure.run([given.kernel, given.cache, mesh]).text()
            version = embree_version(theirs)
            rays(mesh, ours, theirs, how, version, round)
            trees(mesh, ours, theirs, embree.memory(mesh) if round == 0 else None, version, round)


if __name__ == "__main__":
    main()
