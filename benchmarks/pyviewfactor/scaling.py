"""How long the matrix of an obstructed room takes for about 100, 1 000 and 10 000 facets.

    python3 scaling.py STERADIAN

Processor time of all threads and the greatest memory. Pairs cost as n^2, rays as n; the number of rays a row is that of RAYS."""

import os
import resource
import subprocess
import sys
import tempfile

import room

RAYS = "16384"
RUNS = [(1, "pairs"), (1, "rays"), (4, "pairs"), (4, "rays"), (12, "rays")]


def obj(n):
    lines, number = [], 1
    for square in room.squares(n):
        lines += ["v %.12g %.12g %.12g" % corner for corner in square]
        lines.append("f " + " ".join(str(number + k) for k in range(4)))
        number += 4
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "room.obj")
        for n, method in RUNS:
            with open(path, "w") as file:
                file.write(obj(n))
            stop = ["--samples", RAYS] if method == "rays" else ["--rel-error", "1%"]
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            command = [sys.argv[1], "form-factor", path, "--method", method, *stop]
            done = subprocess.run(command, capture_output=True, text=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            taken = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            print(f"{72 * n * n:6} facets by {method:5} {taken:8.1f} s   memory up to {after.ru_maxrss / 1024:.0f} MiB   exit {done.returncode}", flush=True)
            print("   " + "\n   ".join(done.stdout.splitlines()[-3:]), flush=True)
