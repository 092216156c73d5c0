"""What the programs of the suite share: figures as lines of JSON, the cost of a command, and rounds in which programs take turns.

A figure is one measurement of one round. `cargo xtask bench` collects them, takes medians and prints the table; a program of
this folder run by hand prints the same lines.
"""

import argparse
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import typing

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
LAUNCHER = pathlib.Path(__file__).with_name("launch.py")


class Cost(typing.NamedTuple):
    """What a command took, as the operating system counts it once the command has ended."""

    cpu_seconds: float
    wall_seconds: float
    peak_bytes: int
    """The largest resident set of any of its processes."""
    output: bytes

    def text(self):
        return self.output.decode()


def run(command, accept=(0,), **options):
    """Runs a command to its end. Its exit status must be one of `accept`."""
    reading, writing = os.pipe()
    launched = [sys.executable, "-S", str(LAUNCHER), str(writing), *map(str, command)]
    done = subprocess.run(launched, stdout=subprocess.PIPE, stderr=subprocess.PIPE, pass_fds=[writing], **options)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        cost = json.loads(pipe.read() or b"{}")
    if done.returncode not in accept or not cost:
        raise SystemExit(f"{' '.join(map(str, command))}: exit status {done.returncode}\n{done.stderr.decode()}")
    return Cost(cost["cpu_seconds"], cost["wall_seconds"], cost["peak_bytes"], done.stdout)


def figure(what, unit, ours, *, round, peer=None, theirs=None, better="more", goal=None, how=""):
    """Prints a figure. `better` says whether more of it is better or less; `goal` is the ratio that is aimed at."""
    line = {"what": what, "unit": unit, "ours": ours, "peer": peer, "theirs": theirs, "better": better, "goal": goal, "how": how, "round": round}
    print(json.dumps(line), flush=True)


def note(text):
    """Prints a line for the reader of the table."""
    print(json.dumps({"note": text}), flush=True)


def missing(peer, install):
    """Says that a peer is not there and how it can be had."""
    print(json.dumps({"missing": peer, "install": install}), flush=True)


def progress(text):
    print(text, file=sys.stderr, flush=True)


def options(description, **more):
    """The command line that all programs of the suite have; `more` adds flags, by name and what argparse wants to know."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=REPOSITORY / "target/release/steradian", help="the binary of steradian")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--quick", action="store_true", help="smaller and fewer; for a look, not for figures to quote")
    parser.add_argument("--cache", type=pathlib.Path, default=REPOSITORY / "target/bench", help="where meshes and reference pictures are kept")
    for name, settings in more.items():
        parser.add_argument(f"--{name.replace('_', '-')}", **settings)
    given = parser.parse_args()
    given.cache.mkdir(parents=True, exist_ok=True)
    return given


def machine():
    """The processor and how many of them there are."""
    try:
        found = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    except OSError:
        found = None
    return f"{os.cpu_count()} x {found.group(1) if found else platform.processor() or platform.machine()}, {platform.system()}"
