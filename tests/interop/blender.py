"""python blender.py SCENE.glb BAKED.glb: imports both into Blender and fails where names, materials, lights, cameras or
vertex colours are lost on the way through a bake."""

import sys

import bpy


def contents(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    # Blender appends a number to objects whose name is taken.
    plain = lambda name: name.rsplit(".", 1)[0] if name[-4:-3] == "." and name[-3:].isdigit() else name
    objects = list(bpy.data.objects)
    of = lambda kind: sorted(plain(o.name) for o in objects if o.type == kind)
    meshes = [o for o in objects if o.type == "MESH"]
    worn = {plain(slot.material.name) for o in meshes for slot in o.material_slots if slot.material}
    found = {"meshes": of("MESH"), "lights": of("LIGHT"), "cameras": of("CAMERA"), "materials": sorted(worn)}
    coloured = sum(bool(o.data.color_attributes) for o in meshes)
    triangles = sum(len(o.data.polygons) for o in meshes)
    return found, coloured, triangles


scene, baked = sys.argv[1:]
before, _, few = contents(scene)
after, coloured, many = contents(baked)
print(f"{baked} in Blender {bpy.app.version_string}: {len(after['meshes'])} meshes, {coloured} with colours, "
      f"{len(after['materials'])} materials, {len(after['lights'])} lights, {len(after['cameras'])} cameras, "
      f"{few} triangles became {many}")
lost = [f"{kind}: {before[kind]} became {after[kind]}" for kind in before if before[kind] != after[kind]]
for line in lost:
    print(" ", line)
sys.exit(1 if lost or coloured != len(after["meshes"]) or many < few else 0)
