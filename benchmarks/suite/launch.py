"""usage: launch.py DESCRIPTOR COMMAND [ARGUMENT ...]

Runs a command and writes to the file descriptor what it cost, as JSON. The peak of resident memory that Linux reports for a
command is at least that of the process which started it; this one is small, whatever the program that wants to know.
"""

import json
import os
import resource
import sys
import time

descriptor, command = int(sys.argv[1]), sys.argv[2:]
start = time.monotonic()
child = os.fork()
if child == 0:
    os.close(descriptor)
    try:
        os.execvp(command[0], command)
    except OSError as error:
        sys.stderr.write(f"{command[0]}: {error.strerror}\n")
        os._exit(127)
_, status = os.waitpid(child, 0)
wall = time.monotonic() - start
used = resource.getrusage(resource.RUSAGE_CHILDREN)
unit = 1 if sys.platform == "darwin" else 1024
cost = {"cpu_seconds": used.ru_utime + used.ru_stime, "wall_seconds": wall, "peak_bytes": used.ru_maxrss * unit}
os.write(descriptor, json.dumps(cost).encode())
sys.exit(os.waitstatus_to_exitcode(status) & 0xFF)
