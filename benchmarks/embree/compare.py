#!/usr/bin/env python3
"""Rays per second, ours over Embree's, on the same meshes and rays.

usage: compare.py PEER_SOURCE.c [--rounds 3] [--directory DIR] [--mesh NAME ...]

PEER_SOURCE.c is a C program that traces with Embree; README.md says what it must print and write. Both programs run
alternately, one thread each, and count processor time; the figure of a set is the best of its rounds on either side.
"""

import argparse
import pathlib
import re
import subprocess
import tempfile

LINE = re.compile(r"^(\S+) (primary|diffuse|shadow) (closest|anyhit)_single Mrays_per_s: (\S+)", re.M)
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


def run(command, **options):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, **options).stdout


def build_peer(source, directory):
    program = directory / "embree_rays"
    run(["gcc", "-O3", "-march=native", "-o", str(program), str(source), "-lembree3", "-lm"])
    return program


def build_ours():
    command = ["cargo", "bench", "--quiet", "-p", "steradian-benches", "--bench", "kernel_embree", "--no-run"]
    run(command, cwd=REPOSITORY)
    message = subprocess.run(command[:2] + command[3:], cwd=REPOSITORY, text=True, stderr=subprocess.PIPE, check=True)
    path = re.search(r"Executable .*\((.*)\)", message.stderr).group(1)
    return REPOSITORY / path


def best(figures, text):
    for mesh, kind, query, speed in LINE.findall(text):
        key = (mesh, kind, query)
        figures[key] = max(figures.get(key, 0.0), float(speed))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("peer", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--directory", type=pathlib.Path, help="where meshes and rays go (default: a temporary one)")
    parser.add_argument("--mesh", nargs="*", default=[])
    arguments = parser.parse_args()
    directory = arguments.directory or pathlib.Path(tempfile.mkdtemp(prefix="steradian-embree-"))
    directory.mkdir(parents=True, exist_ok=True)
    peer, ours = build_peer(arguments.peer, directory), build_ours()
    theirs_best, ours_best = {}, {}
    for _ in range(arguments.rounds):
        best(theirs_best, run([str(peer), "all", "1024", "2", str(directory)]))
        best(ours_best, run([str(ours), str(directory), "2", *arguments.mesh]))
    print(f"{'mesh':12}{'rays':9}{'query':9}{'ours':>9}{'Embree':>9}{'ratio':>8}   (Mrays/s)")
    for key, speed in ours_best.items():
        peer_speed = theirs_best[key]
        print(f"{key[0]:12}{key[1]:9}{key[2]:9}{speed:9.3f}{peer_speed:9.3f}{speed / peer_speed:8.3f}")


if __name__ == "__main__":
    main()
