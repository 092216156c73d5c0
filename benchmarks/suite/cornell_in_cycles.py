#!/usr/bin/env python3
"""The Cornell box rendered by Blender's Cycles, on demand; wants a Python that has bpy.

usage: cornell_in_cycles.py OUTPUT.npy     reads lines `SAMPLES SEED SIZE`, writes OUTPUT.npy and answers with the processor seconds

Linear radiance, 256 x 256 pixels unless SIZE is less, one thread, at most 8 segments, Gaussian filter of σ = ½, the sampling
pattern that Cycles chooses by itself, no clamping, no denoising, no adaptive sampling.
"""

import os
import sys
import time

import bpy
import numpy

SEGMENTS = 8
WHITE, GREEN, RED = (0.885809, 0.698859, 0.666422), (0.105421, 0.37798, 0.076425), (0.570068, 0.0430135, 0.0443706)
RADIANCE = numpy.array([18.387, 13.9873, 6.75357])


def diffuse(name, color):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    surface, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    surface.inputs["Color"].default_value = (*color, 1.0)
    links.new(surface.outputs[0], output.inputs["Surface"])
    return material


def lamp(front):
    """Emits and reflects on its front; black on its back."""
    material = diffuse("lamp", front)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    emission, both, black, sides, side = (
        nodes.new(kind)
        for kind in ("ShaderNodeEmission", "ShaderNodeAddShader", "ShaderNodeBsdfDiffuse", "ShaderNodeMixShader", "ShaderNodeNewGeometry")
    )
    emission.inputs["Color"].default_value = (*(RADIANCE / RADIANCE.max()), 1.0)
    emission.inputs["Strength"].default_value = RADIANCE.max()
    black.inputs["Color"].default_value = (0, 0, 0, 1)
    reflecting = next(node for node in nodes if node.bl_idname == "ShaderNodeBsdfDiffuse" and node is not black)
    output = next(node for node in nodes if node.bl_idname == "ShaderNodeOutputMaterial")
    links.new(reflecting.outputs[0], both.inputs[0])
    links.new(emission.outputs[0], both.inputs[1])
    links.new(side.outputs["Backfacing"], sides.inputs[0])
    links.new(both.outputs[0], sides.inputs[1])
    links.new(black.outputs[0], sides.inputs[2])
    links.new(sides.outputs[0], output.inputs["Surface"])
    return material


def add(name, vertices, faces, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, vertex)) for vertex in vertices], [], faces)
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def rectangle(name, corner, first, second, material):
    corner, first, second = map(numpy.array, (corner, first, second))
    add(name, [corner, corner + first, corner + first + second, corner + second], [(0, 1, 2, 3)], material)


def box(name, half, degrees, middle, material):
    angle = numpy.radians(degrees)
    turn = numpy.array([[numpy.cos(angle), 0, numpy.sin(angle)], [0, 1, 0], [-numpy.sin(angle), 0, numpy.cos(angle)]])
    signs = numpy.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    add(name, signs * half @ turn.T + middle, faces, material)


def build():
    """Blender's axes are those of the scene file, y up; its camera looks along -z, as that of the box does."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="cycles")
    white, green, red = diffuse("white", WHITE), diffuse("green", GREEN), diffuse("red", RED)
    rectangle("lamp", (-0.23, 0.99, -0.18), (0.46, 0, 0), (0, 0, 0.38), lamp(WHITE))
    rectangle("floor", (-1, -1, 1), (2, 0, 0), (0, 0, -2), white)
    rectangle("ceiling", (-1, 1, -1), (2, 0, 0), (0, 0, 2), white)
    rectangle("back", (-1, -1, -1), (2, 0, 0), (0, 2, 0), white)
    rectangle("green wall", (1, -1, -1), (0, 0, 2), (0, 2, 0), green)
    rectangle("red wall", (-1, -1, -1), (0, 2, 0), (0, 0, 2), red)
    box("small box", 0.3, -17, (0.335, -0.7, 0.38), white)
    box("large box", (0.3, 0.61, 0.3), 18.25, (-0.33, -0.4, -0.28), white)
    camera = bpy.data.cameras.new("camera")
    camera.angle = numpy.radians(39.3077)
    camera.clip_start = 0.01
    placed = bpy.data.objects.new("camera", camera)
    placed.location = (0, 0, 3.9)
    bpy.context.scene.collection.objects.link(placed)
    bpy.context.scene.camera = placed


def settings(scene):
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    cycles = scene.cycles
    cycles.device, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", False, False
    cycles.max_bounces = cycles.diffuse_bounces = SEGMENTS - 2
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    # Cycles' Gaussian falls as exp(-8 x² / width²): σ is a quarter of the width.
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 2.0


def render(samples, seed, size, output):
    scene = bpy.context.scene
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.filepath = output.removesuffix(".npy") + ".exr"
    start = time.process_time()
    bpy.ops.render.render(write_still=True)
    seconds = time.process_time() - start
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    pixels = numpy.array(image.pixels[:]).reshape(size, size, 4)[::-1, :, :3]
    bpy.data.images.remove(image)
    numpy.save(output, pixels)
    return seconds


def main():
    # Blender talks on standard output; the answers go out by a copy of it.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    build()
    settings(bpy.context.scene)
    print(bpy.app.version_string, file=answers, flush=True)
    for line in sys.stdin:
        print(render(*map(int, line.split()), sys.argv[1]), file=answers, flush=True)


if __name__ == "__main__":
    main()
