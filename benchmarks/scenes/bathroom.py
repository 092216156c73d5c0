"""A bathroom of some 380 000 triangles, of which only the lamps shine.

The file is not part of this repository (benchmarks/README.md says what it is). Of each of its materials a simpler one is made that both
programs define alike: metals are rough conductors, all others diffuse; the glass around the lamps is left out. Mirrors become rough as well:
what they and smooth coats throw of lamps as small as these is found by few paths of either program, and would decide the figure alone.
"""

import json
import struct

import numpy

import twin

NAME = "Bathroom"
INSTALL = "give its file by --bathroom; benchmarks/README.md tells where it comes from"
SIZE = (128, 128)
DEPTH = 8
SAMPLES = 64
LONG = 64
GLASS, RADIANCE, LEAST_ALPHA = "BulbGlass", 100.0, 0.2
FOV = 55
HEAD = '[scene]\nname = "Bathroom"\nspectrum = "rgb"\n'

file = None


def prepare(given):
    """Notes where the file lies; false if it is not there."""
    global file
    file = given.bathroom
    return bool(file)


def read_glb(path):
    """The description and the binary chunk of a GLB file."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), memoryview(data)[28 + length :]


def accessor(gltf, binary, number):
    """The values of an accessor, rows of one or three."""
    this = gltf["accessors"][number]
    view = gltf["bufferViews"][this["bufferView"]]
    start, width = view.get("byteOffset", 0) + this.get("byteOffset", 0), {"SCALAR": 1, "VEC3": 3}[this["type"]]
    kind = {5123: "<u2", 5125: "<u4", 5126: "<f4"}[this["componentType"]]
    return numpy.frombuffer(binary, kind, this["count"] * width, start).reshape(-1, width)


def z_up(vectors):
    """From glTF's axes, y up, to ours."""
    return vectors[..., [0, 2, 1]] * [1, -1, 1]


class Part:
    """The triangles of one material."""

    def __init__(self, gltf, binary, primitive):
        material = gltf["materials"][primitive["material"]]
        surface = material["pbrMetallicRoughness"]
        self.name = material["name"]
        self.shines = "emissiveFactor" in material
        self.color = [float(value) for value in surface["baseColorFactor"][:3]]
        self.metallic = surface["metallicFactor"] > 0.5
        self.alpha = max(LEAST_ALPHA, surface["roughnessFactor"] ** 2)
        self.vertices = z_up(accessor(gltf, binary, primitive["attributes"]["POSITION"]))
        self.triangles = accessor(gltf, binary, primitive["indices"]).reshape(-1, 3)

    def ours(self):
        """The material's table and the shape's."""
        diffuse = f'model = "lambertian"\nreflectance = {self.color}'
        model = twin.OUR_METAL.format(alpha=self.alpha) if self.metallic else diffuse
        emission = f'emission = {{ radiance = "{RADIANCE} W/(m2 sr)" }}\n' if self.shines else ""
        return f'\n[materials.{self.name}]\n{model}\n\n[[shapes]]\nkind = "mesh"\nfile = "{self.name}.ply"\nmaterial = "{self.name}"\n{emission}'

    def theirs(self, folder):
        bsdf = twin.metal(self.alpha) if self.metallic else twin.diffuse(self.color)
        shape = {"type": "ply", "filename": str(folder / f"{self.name}.ply"), "face_normals": True, "bsdf": bsdf}
        return shape | ({"emitter": twin.area(RADIANCE)} if self.shines else {})


def parts():
    gltf, binary = read_glb(file)
    every = [Part(gltf, binary, primitive) for primitive in gltf["meshes"][0]["primitives"]]
    return [part for part in every if part.name != GLASS]


def view():
    """Position and a point that is looked at."""
    gltf, _ = read_glb(file)
    matrix = numpy.array(next(node["matrix"] for node in gltf["nodes"] if "camera" in node)).reshape(4, 4)
    position = z_up(matrix[3, :3])
    return position.tolist(), (position - z_up(matrix[2, :3])).tolist()


def ours(folder):
    position, look_at = view()
    camera = f'\n[[sensors]]\nname = "camera"\nkind = "camera"\nposition = {position}\nlook_at = {look_at}\nfov = "{FOV} deg"\nresolution = {list(SIZE)}\n'
    every = parts()
    for part in every:
        twin.write_ply(part.vertices, part.triangles, folder / f"{part.name}.ply")
    path = folder / "bathroom.toml"
    path.write_text(HEAD + "".join(part.ours() for part in every) + camera)
    return path


def theirs(folder):
    """After `ours`, which writes the meshes."""
    shapes = {part.name: part.theirs(folder) for part in parts()}
    return {"type": "scene", **shapes, "sensor": twin.camera(*view(), FOV)}
