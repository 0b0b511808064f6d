# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Renders what `vinebench render --export FOLDER` wrote with Blender's path tracer.

    blender --background --python-exit-code 1 --python tools/cycles/render.py -- FOLDER OUT.png [--samples N] [--threads N]

The light has the renderer's own units: a white surface that faces the sun is 1. A sun lamp of
strength pi and a sky of radiance 1 each give a white diffuse surface the brightness 1.
"""

import argparse
import json
import math
import pathlib
import sys

import bpy
import numpy
from mathutils import Matrix, Vector

if not hasattr(numpy, "bool"):  # the glTF importer of Debian's Blender 3.4 asks for it
    numpy.bool = bool

TRANSMITTED = (1.05, 1.15, 0.55)  # the tint of light through a leaf, as in our shaders


def arguments():
    after = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(description="A picture by Cycles of an exported view")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--samples", type=int, default=64, help="of each pixel")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--bounces", type=int, default=6)
    return parser.parse_args(after)


def set_camera(scene, view):
    """Our optical frame looks along z with y down, Blender's along -z with y up."""
    data = bpy.data.cameras.new("camera")
    camera = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(camera)
    rows = view["T_world_cam"]
    optical = Matrix([rows[4 * i:4 * i + 4] for i in range(4)])
    camera.matrix_world = optical @ Matrix.Diagonal(Vector((1, -1, -1, 1)))
    width, height = view["width"], view["height"]
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = 36
    data.lens = view["fx"] * data.sensor_width / width
    data.shift_x = -(view["cx"] - (width - 1) / 2) / width
    data.shift_y = (view["cy"] - (height - 1) / 2) / width * view["fx"] / view["fy"]
    data.clip_start = 0.02
    data.clip_end = 2000
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    # Blender's aspect is of pixels, their height against their width where a pixel is wide.
    scene.render.pixel_aspect_x = max(1, view["fy"] / view["fx"])
    scene.render.pixel_aspect_y = max(1, view["fx"] / view["fy"])


def set_sun(scene, sun):
    strength = max(sun["colour"])
    if strength <= 0:
        return
    data = bpy.data.lights.new("sun", "SUN")
    data.angle = math.radians(0.53)
    data.energy = math.pi * strength
    data.color = [part / strength for part in sun["colour"]]
    lamp = bpy.data.objects.new("sun", data)
    lamp.rotation_euler = Vector(sun["towards"]).to_track_quat("Z", "Y").to_euler()
    scene.collection.objects.link(lamp)


def set_sky(scene, folder, sky):
    """The camera sees the sky darker than it lights, as in our renderer."""
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    image = tree.nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(str(folder / sky["image"]))
    seen = tree.nodes.new("ShaderNodeBackground")
    light = tree.nodes.new("ShaderNodeBackground")
    light.inputs["Strength"].default_value = sky["lighting"]
    by_ray = tree.nodes.new("ShaderNodeLightPath")
    mix = tree.nodes.new("ShaderNodeMixShader")
    out = tree.nodes.new("ShaderNodeOutputWorld")
    for background in (seen, light):
        tree.links.new(image.outputs["Color"], background.inputs["Color"])
    tree.links.new(by_ray.outputs["Is Camera Ray"], mix.inputs[0])
    tree.links.new(light.outputs[0], mix.inputs[1])
    tree.links.new(seen.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], out.inputs["Surface"])


def set_material(material):
    """Diffuse, as our shaders are; leaves let light through; cut-outs at an alpha of one half."""
    share = material.get("translucency", 0.0)
    tree = material.node_tree
    principled = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    if principled is None:
        return
    out = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")

    def feed(socket, target):
        if socket.is_linked:
            tree.links.new(socket.links[0].from_socket, target)
        else:
            target.default_value = socket.default_value

    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    feed(principled.inputs["Base Color"], shader.inputs["Color"])
    if share > 0:
        tint = tree.nodes.new("ShaderNodeMixRGB")
        tint.blend_type = "MULTIPLY"
        tint.inputs[0].default_value = 1
        feed(principled.inputs["Base Color"], tint.inputs[1])
        tint.inputs[2].default_value = [share * part for part in TRANSMITTED] + [1]
        through = tree.nodes.new("ShaderNodeBsdfTranslucent")
        tree.links.new(tint.outputs[0], through.inputs["Color"])
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(shader.outputs[0], both.inputs[0])
        tree.links.new(through.outputs[0], both.inputs[1])
        shader = both
    if material.blend_method != "OPAQUE":
        edge = tree.nodes.new("ShaderNodeMath")
        edge.operation = "GREATER_THAN"
        edge.inputs[1].default_value = 0.5
        feed(principled.inputs["Alpha"], edge.inputs[0])
        hole = tree.nodes.new("ShaderNodeBsdfTransparent")
        cut = tree.nodes.new("ShaderNodeMixShader")
        tree.links.new(edge.outputs[0], cut.inputs[0])
        tree.links.new(hole.outputs[0], cut.inputs[1])
        tree.links.new(shader.outputs[0], cut.inputs[2])
        shader = cut
    tree.links.new(shader.outputs[0], out.inputs["Surface"])


def set_render(scene, args, exposure):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = args.samples
    cycles.use_denoising = False
    cycles.seed = 0
    cycles.max_bounces = args.bounces
    cycles.diffuse_bounces = args.bounces
    cycles.transparent_max_bounces = 64
    cycles.filter_width = 1.0
    cycles.pixel_filter_type = "BOX"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = args.threads
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.exposure = math.log2(exposure)
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.filepath = str(args.out.resolve())


def main():
    args = arguments()
    folder = args.folder.resolve()
    view = json.loads((folder / "camera.json").read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.import_scene.gltf(filepath=str(folder / "scene.glb"))
    for material in bpy.data.materials:
        if material.use_nodes:
            set_material(material)
    set_camera(scene, view)
    set_sun(scene, view["sun"])
    set_sky(scene, folder, view["sky"])
    set_render(scene, args, view["exposure"])
    bpy.ops.render.render(write_still=True)


main()
