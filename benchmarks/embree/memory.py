#!/usr/bin/env python3
"""Build a mesh with Embree and print the time and the memory of its tree, as a line of JSON.

usage: memory.py DIRECTORY MESH [--quality high|medium] [--library libembree3.so.3]

Reads DIRECTORY/MESH.verts.f32 and MESH.tris.u32, which Embree is given as shared buffers, so that what its memory monitor counts
is the tree alone: what it holds when the build is over, and the most it held on the way. One thread, processor time.
"""

import argparse
import ctypes
import json
import pathlib
import time

import numpy

TRIANGLES, INDICES, POSITIONS = 0, 0, 1
FLOAT3, UINT3 = 0x9003, 0x5003
QUALITY = {"medium": 1, "high": 2}
MONITOR = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_void_p, ctypes.c_ssize_t, ctypes.c_bool)


class Memory:
    """What Embree says it takes and gives back."""

    def __init__(self):
        self.now = self.most = 0
        self.callback = MONITOR(self.change)

    def change(self, _user, size, _after):
        self.now += size
        self.most = max(self.most, self.now)
        return True


def handles(library, *names):
    """Functions that return pointers."""
    for name in names:
        getattr(library, name).restype = ctypes.c_void_p


def build(library, vertices, triangles, quality):
    """Processor seconds, bytes of the finished tree, most bytes on the way."""
    pointer = ctypes.c_void_p
    handles(library, "rtcNewDevice", "rtcNewScene", "rtcNewGeometry")
    device, memory = pointer(library.rtcNewDevice(b"threads=1,set_affinity=0")), Memory()
    library.rtcSetDeviceMemoryMonitorFunction(device, memory.callback, None)
    scene, geometry = pointer(library.rtcNewScene(device)), pointer(library.rtcNewGeometry(device, TRIANGLES))
    library.rtcSetSceneBuildQuality(scene, QUALITY[quality])
    for kind, form, values in ((POSITIONS, FLOAT3, vertices), (INDICES, UINT3, triangles)):
        size = ctypes.c_size_t
        library.rtcSetSharedGeometryBuffer(geometry, kind, 0, form, pointer(values.ctypes.data), size(0), size(12), size(len(values) // 3))
    library.rtcCommitGeometry(geometry)
    library.rtcAttachGeometry(scene, geometry)
    before, start = memory.now, time.process_time()
    library.rtcCommitScene(scene)
    seconds = time.process_time() - start
    error = library.rtcGetDeviceError(device)
    if error:
        raise SystemExit(f"Embree: error {error}")
    return seconds, memory.now - before, memory.most - before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("mesh")
    parser.add_argument("--quality", choices=QUALITY, default="high")
    parser.add_argument("--library", default="libembree3.so.3")
    given = parser.parse_args()
    # Four bytes more: Embree reads the last vertex as four floats.
    vertices = numpy.append(numpy.fromfile(given.directory / f"{given.mesh}.verts.f32", "<f4"), numpy.float32(0))
    triangles = numpy.fromfile(given.directory / f"{given.mesh}.tris.u32", "<u4")
    seconds, bytes_, most = build(ctypes.CDLL(given.library), vertices, triangles, given.quality)
    print(json.dumps({"triangles": len(triangles) // 3, "cpu_seconds": seconds, "bytes": bytes_, "most_bytes": most}))


if __name__ == "__main__":
    main()
