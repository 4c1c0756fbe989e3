"""A character as a .glb file in which each vertex has its number."""
import bpy
import numpy as np

from . import vertex_numbers
from .faults import Fault

# Colours of earlier bakes. They are no part of the character, and colours at corners would split vertices.
OWN_COLOURS = ("Nook AO", "Nook traced")


def _numbered_copy(mesh, first):
    """A copy of a mesh with the numbers of its vertices as an attribute; the artist's mesh is not touched."""
    copy = mesh.copy()
    for name in OWN_COLOURS:
        if name in copy.attributes:
            copy.attributes.remove(copy.attributes[name])
    attribute = copy.attributes.new(vertex_numbers.NAME, "FLOAT", "POINT")
    attribute.data.foreach_set("value", np.arange(first, first + len(copy.vertices), dtype=np.float32))
    return copy


def export_character(context, armature, meshes, path, with_clips):
    """Writes armature and meshes to `path`. The selection and the meshes are afterwards as they were."""
    count = sum(len(o.data.vertices) for o in meshes)
    if count > vertex_numbers.LARGEST:
        raise Fault(f"the character has {count} vertices; at most {vertex_numbers.LARGEST} can be numbered")
    if not hasattr(bpy.types, "EXPORT_SCENE_OT_gltf"):
        raise Fault("the exporter of glTF is switched off; switch on the add-on glTF 2.0 format in Blender's preferences")
    selected, active = list(context.selected_objects), context.view_layer.objects.active
    own = [o.data for o in meshes]
    copies = []
    try:
        first = 0
        for mesh in meshes:
            copies.append(_numbered_copy(mesh.data, first))
            first += len(mesh.data.vertices)
        for mesh, copy in zip(meshes, copies):
            mesh.data = copy
        for candidate in selected:
            candidate.select_set(False)
        for part in (armature, *meshes):
            part.select_set(True)
        context.view_layer.objects.active = armature
        bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", use_selection=True, export_attributes=True, export_apply=False,
                                  export_animations=with_clips, export_skins=True, export_morph=False, export_materials="PLACEHOLDER",
                                  export_cameras=False, export_lights=False, export_yup=True)
    except RuntimeError as error:
        raise Fault(f"the exporter of glTF failed: {error}") from error
    finally:
        for mesh, data in zip(meshes, own):
            mesh.data = data
        for copy in copies:
            bpy.data.meshes.remove(copy)
        for candidate in context.selected_objects:
            candidate.select_set(False)
        for candidate in selected:
            candidate.select_set(True)
        context.view_layer.objects.active = active
