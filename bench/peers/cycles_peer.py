"""Renders exported scenes with Blender's Cycles, for `wedge bench peers` (see peer_loop.py for how it is told what
to do).

    pip install bpy numpy       # Blender as a Python module; bpy 5.0.1 is for Python 3.11

Lambert surfaces with textures, meshes and rectangles that shine on their front, points, a sky of one colour.
Everything that makes Cycles faster at the price of bias is off, and so is what it does for pictures: denoiser,
clamping, adaptive sampling, light threshold, filters of gloss, shadow terminator. docs/peers.md
lists all conventions.
"""

import os
import tempfile
import time

import bpy
import mathutils
import numpy as np

import exported_scene
import peer_loop

# Of the distance from which the whole scene is seen.
NEAR_SHARE, FAR_SHARE = 1e-4, 4.0


class Nodes:
    """A small tree of shading nodes."""

    def __init__(self, tree, folder):
        self.tree, self.folder = tree, folder
        tree.nodes.clear()

    def add(self, kind):
        return self.tree.nodes.new(kind)

    def link(self, source, target):
        self.tree.links.new(source, target)

    def set_colour(self, socket, constant, image):
        if image:
            self.link(self.texture(image), socket)
        else:
            socket.default_value = [*constant, 1]

    def texture(self, image):
        """Texels are linear and start at the bottom, as in Wedge."""
        coordinates, node = self.add("ShaderNodeUVMap"), self.add("ShaderNodeTexImage")
        mapping = self.add("ShaderNodeMapping")
        mapping.inputs["Scale"].default_value = [*image["scale"], 1]
        mapping.inputs["Location"].default_value = [*image["offset"], 0]
        node.image = bpy.data.images.load(os.path.join(self.folder, image["file"]), check_existing=True)
        node.image.colorspace_settings.is_data = True
        node.interpolation = "Linear"
        node.extension = "EXTEND" if image["clamp"] else "REPEAT"
        self.link(coordinates.outputs["UV"], mapping.inputs["Vector"])
        self.link(mapping.outputs["Vector"], node.inputs["Vector"])
        return node.outputs["Color"]

    def front_emission(self, constant, image):
        """Radiance where the face's winding is counter-clockwise, none behind."""
        emission, geometry = self.add("ShaderNodeEmission"), self.add("ShaderNodeNewGeometry")
        self.set_colour(emission.inputs["Color"], constant, image)
        front = self.add("ShaderNodeMath")
        front.operation = "SUBTRACT"
        front.inputs[0].default_value = 1
        self.link(geometry.outputs["Backfacing"], front.inputs[1])
        self.link(front.outputs["Value"], emission.inputs["Strength"])
        return emission.outputs["Emission"]


def make_material(name, surface, folder):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = Nodes(material.node_tree, folder)
    diffuse = nodes.add("ShaderNodeBsdfDiffuse")  # of roughness 0: Lambert
    diffuse.inputs["Roughness"].default_value = 0
    nodes.set_colour(diffuse.inputs["Color"], surface["kd"], surface.get("kd_image"))
    made = diffuse.outputs["BSDF"]
    if any(surface["emission"]):
        both = nodes.add("ShaderNodeAddShader")
        nodes.link(made, both.inputs[0])
        nodes.link(nodes.front_emission(surface["emission"], surface.get("emission_image")), both.inputs[1])
        made = both.outputs["Shader"]
        material.cycles.emission_sampling = "FRONT"
    nodes.link(made, nodes.add("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add_surface(scene, name, surface, positions, uvs, triangles, folder):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(positions, [], triangles)
    layer = mesh.uv_layers.new(name="uv")
    corners = np.array(triangles, dtype=np.int64).reshape(-1)
    layer.data.foreach_set("uv", np.array(uvs, dtype=np.float32)[corners].reshape(-1))
    mesh.materials.append(make_material(name, surface, folder))
    thing = bpy.data.objects.new(name, mesh)
    thing.cycles.shadow_terminator_offset = thing.cycles.shadow_terminator_geometry_offset = 0
    scene.collection.objects.link(thing)


def add_point(scene, point):
    """Cycles counts watts: intensity of a point is its power over 4 pi steradians and over pi."""
    light = bpy.data.lights.new("point", "POINT")
    largest = max(point["intensity"])
    light.color = [x / largest for x in point["intensity"]]
    light.energy = largest * 4 * np.pi * np.pi
    light.shadow_soft_size = 0
    thing = bpy.data.objects.new("point", light)
    thing.location = point["position"]
    scene.collection.objects.link(thing)


def set_sky(scene, background):
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    nodes = Nodes(scene.world.node_tree, "")
    sky = nodes.add("ShaderNodeBackground")
    sky.inputs["Color"].default_value = [*background, 1]
    nodes.link(sky.outputs["Background"], nodes.add("ShaderNodeOutputWorld").inputs["Surface"])


def set_camera(scene, exported):
    camera = exported["camera"]
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle_y = camera["vertical_fov_rad"]
    distance = exported_scene.farthest(exported)
    data.clip_start, data.clip_end = NEAR_SHARE * distance, FAR_SHARE * distance
    thing = bpy.data.objects.new("camera", data)
    columns = [*exported_scene.camera_axes(camera), camera["position"]]
    rows = [[column[i] for column in columns] for i in range(3)] + [[0, 0, 0, 1]]
    thing.matrix_world = mathutils.Matrix(rows)
    scene.collection.objects.link(thing)
    scene.camera = thing


def set_integrator(scene, exported):
    scene.render.engine = "CYCLES"
    c = scene.cycles
    c.device = "CPU"
    c.use_adaptive_sampling = c.use_denoising = c.use_guiding = c.use_light_tree = c.use_fast_gi = False
    c.sample_clamp_direct = c.sample_clamp_indirect = 0
    c.light_sampling_threshold = 0
    c.blur_glossy = 0
    c.caustics_reflective = c.caustics_refractive = True
    c.pixel_filter_type = "BOX"
    c.sampling_pattern = "TABULATED_SOBOL"
    bounces = exported["bounces"]
    c.max_bounces = c.diffuse_bounces = c.glossy_bounces = c.transmission_bounces = bounces
    c.use_animated_seed = False


def set_film(scene, film):
    render = scene.render
    render.resolution_x, render.resolution_y = film["width"], film["height"]
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.use_persistent_data = True  # tree and textures stay between renders
    render.use_compositing = render.use_sequencer = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"


class CyclesPeer:
    def load(self, folder, method):
        start = time.perf_counter()
        exported = exported_scene.read(folder)
        exported_scene.require_lambert(exported, "Cycles")
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        for name, surface, *shape in exported_scene.surfaces(exported, folder):
            add_surface(self.scene, name, surface, *shape, folder)
        for point in exported["points"]:
            add_point(self.scene, point)
        set_sky(self.scene, exported["background"])
        set_camera(self.scene, exported)
        set_integrator(self.scene, exported)
        set_film(self.scene, exported["film"])
        self.temporary = tempfile.TemporaryDirectory()
        self.render_once(1, 0)  # copies the scene to Cycles and builds its tree, which stay
        return {"load_s": time.perf_counter() - start}

    def describe(self):
        return {"version": "Cycles of Blender " + bpy.app.version_string, "device": "CPU"}

    def render_once(self, spp, seed):
        self.scene.cycles.samples = spp
        self.scene.cycles.seed = seed & 0x7FFFFFFF
        self.scene.update_tag()  # else the first change after loading is not seen
        start = time.perf_counter()
        bpy.ops.render.render()
        return time.perf_counter() - start

    def pixels(self):
        path = os.path.join(self.temporary.name, "pixels.exr")
        bpy.data.images["Render Result"].save_render(path, scene=self.scene)
        image = bpy.data.images.load(path)
        image.colorspace_settings.is_data = True
        width, height = image.size
        values = np.empty(width * height * image.channels, dtype=np.float32)
        image.pixels.foreach_get(values)
        bpy.data.images.remove(image)
        return values.reshape(height, width, -1)[::-1, :, :3]

    def render(self, spp, seed):
        seconds = self.render_once(spp, seed)
        return self.pixels(), {"render_s": seconds, "compile_s": 0}


if __name__ == "__main__":
    peer_loop.serve(CyclesPeer())
