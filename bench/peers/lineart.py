"""lineart.py - Blender's Line Art on a model in page coordinates: blender -b -P
lineart.py -- MODEL OUT features|all

Contours, borders, creases beyond 30 degrees, material and intersection lines;
one level, so that hidden lines are left out; all other settings Blender's own,
but for a stroke's simplification, which is off."""
import math
import sys

import bpy

sys.path.insert(0, __file__.rsplit("/", 1)[0])
import page

model, out, what = sys.argv[sys.argv.index("--") + 1:][:3]
points, faces = page.read_obj(model)
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
mesh = bpy.data.meshes.new("model")
mesh.from_pydata(points, [], faces)
mesh.update()
scene.collection.objects.link(bpy.data.objects.new("model", mesh))

camera = bpy.data.cameras.new("camera")
camera.type = "ORTHO"
camera.ortho_scale = page.PAGE
camera.clip_start, camera.clip_end = 1, 2000
eye = bpy.data.objects.new("eye", camera)
eye.location = (0, 0, 1000)
scene.collection.objects.link(eye)
scene.camera = eye
scene.render.resolution_x = scene.render.resolution_y = 2000

pencil = bpy.data.grease_pencils.new("lines")
layer = pencil.layers.new("lines")
layer.frames.new(1)
material = bpy.data.materials.new("ink")
bpy.data.materials.create_gpencil_data(material)
pencil.materials.append(material)
drawing = bpy.data.objects.new("lines", pencil)
scene.collection.objects.link(drawing)
art = drawing.grease_pencil_modifiers.new("art", "GP_LINEART")
art.source_type = "SCENE"
art.target_layer, art.target_material = "lines", material
art.use_multiple_levels = False
art.level_start = 0
art.use_contour = art.use_crease = art.use_intersection = True
art.use_loose = art.use_material = False
art.crease_threshold = math.radians(180 - 30)
art.use_clip_plane_boundaries = False
art.smooth_tolerance = 0
art.split_angle = 0
art.thickness = 1
if what == "all":
    art.crease_threshold = math.pi
bpy.context.view_layer.update()
result = drawing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
dx, dy = page.read_shift(sys.argv[-1])
lines = []
for layer in result.layers:
    for frame in layer.frames:
        for stroke in frame.strokes:
            lines.append([(p.co[0] + dx, p.co[1] + dy)
                          for p in stroke.points])
page.write_svg(out, lines)
