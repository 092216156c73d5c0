"""Pictures of the Cornell box, rendered alike by Steradian and by Mitsuba 3, with the processor time each took.

Both sides render 256 × 256 pixels with paths of at most 8 segments on one thread. `Steradian.render` and
`Mitsuba.render` have the same arguments and the same result, so that a comparison treats them alike.
"""

import pathlib
import resource
import subprocess
import sys
import tempfile
import time
import typing

import drjit
import mitsuba
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from pfm import read_pfm

SIZE = 256
DEPTH = 8
SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "cornell-box.toml"
FILTERS = ("gaussian", "box")


class Picture(typing.NamedTuple):
    """Radiance by row from the top, column and channel, in W/(m² sr)."""

    values: numpy.ndarray
    cpu_seconds: float
    """User and system time, without starting the program and reading the scene."""
    errors: numpy.ndarray | None = None
    """Standard errors as the program states them, if it does."""


class Steradian:
    name = "Steradian"

    def __init__(self, program, filter="gaussian"):
        self.command = [str(program), "render", str(SCENE), "--filter", filter, "--threads", "1"]
        # A picture of one pixel and no segments: everything but the paths, those of the pilot included.
        self.start_up = self.run(4, 0, "--resolution", "1x1", depth=0).cpu_seconds

    def render(self, samples, seed):
        picture = self.run(samples, seed)
        return picture._replace(cpu_seconds=picture.cpu_seconds - self.start_up)

    def run(self, samples, seed, *more, depth=DEPTH):
        with tempfile.TemporaryDirectory(prefix="steradian-cornell-") as directory:
            output = pathlib.Path(directory, "picture.pfm")
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            command = [*self.command, "--max-depth", str(depth), "--samples", str(samples), "--seed", str(seed), "-o", str(output), *more]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
            return Picture(read_pfm(output), seconds, read_pfm(output.with_suffix(".error.pfm")))


class Mitsuba:
    def __init__(self, sampler="independent", filter="gaussian", variant="llvm_ad_rgb"):
        self.name = f"Mitsuba {sampler}"
        mitsuba.set_variant(variant)
        drjit.set_thread_count(1)
        scene = mitsuba.cornell_box()
        scene["integrator"]["max_depth"] = DEPTH
        scene["sensor"]["film"].update(width=SIZE, height=SIZE, rfilter={"type": filter})
        scene["sensor"]["sampler"] = {"type": sampler, "sample_count": 64}
        self.scene = mitsuba.load_dict(scene)

    def render(self, samples, seed):
        """The first call also compiles the kernel, which later ones of the same process do not."""
        start = time.process_time()
        values = numpy.array(mitsuba.render(self.scene, spp=samples, seed=seed))
        return Picture(values[..., :3].astype(float), time.process_time() - start)


def relative_mse(picture, reference):
    """Mean over pixels and channels of (x - r)² / (r² + 0.01)."""
    return numpy.mean((picture - reference) ** 2 / (reference**2 + 0.01))
