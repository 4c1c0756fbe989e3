"""Characters whose ambient occlusion is shown: the model of each, and the handler that follows the timeline."""
import pathlib

import bpy
import numpy as np

from . import character, folders, library, poses, preferences, vertex_numbers
from .faults import Fault

AO, TRACED = "Nook AO", "Nook traced"
# Where an armature keeps its files, so that a saved scene shows its bake again.
FOLDER_PROPERTY = "nook_folder"
# How many vertices each mesh had at the bake, in the order of the meshes.
COUNTS_PROPERTY = "nook_vertex_counts"
MODEL_FILE, CHARACTER_FILE = "character.nook", "character.glb"


class Shown:
    """A baked character with what leads from its pose in Blender to colours on its meshes."""

    def __init__(self, armature, meshes, folder, nook):
        # Names: an undo replaces the objects themselves.
        self.armature_name, self.mesh_names = armature.name, [o.name for o in meshes]
        self.folder, self.nook, self.painted = pathlib.Path(folder), nook, None
        data = (self.folder / CHARACTER_FILE).read_bytes()
        self.character = nook.Character(data=data)
        self.model = nook.CharacterModel((self.folder / MODEL_FILE).read_bytes())
        if self.model.vertex_count != self.character.vertex_count:
            raise Fault(f"{MODEL_FILE} has {self.model.vertex_count} vertices and {CHARACTER_FILE} {self.character.vertex_count}; bake again")
        self.numbers = vertex_numbers.read_vertex_numbers(data)
        counts = vertex_counts(meshes)
        baked = baked_counts(armature, counts)
        self.count = sum(counts)
        if baked != counts or len(self.numbers) != self.model.vertex_count or self.numbers.max() >= self.count:
            raise Fault(f"the meshes have {counts} vertices, and the bake is of {baked}; bake again after a change of the meshes")
        rest, _ = self.character.vertices()
        self.rest = poses.find_rest_matrix(character.bind_points(armature, meshes)[self.numbers], rest.astype(np.float64))
        self.scene = nook.Scene()
        self.instance = self.scene.add_instance(self.model)

    @property
    def armature(self):
        return bpy.data.objects[self.armature_name]

    @property
    def meshes(self):
        return [bpy.data.objects[name] for name in self.mesh_names]

    def pose(self):
        """The matrices of the pose that Blender has now."""
        # The order is that of the model's bones, which is that of the file.
        skinning = character.skinning_matrices(self.armature, self.model.bone_names)
        return poses.bone_matrices(character.matrix(self.armature.matrix_world), skinning, self.rest)

    def evaluate(self, ground):
        """AO of the pose of now, one value for each vertex of the file; ground darkens from below, at the height of zero."""
        self.instance.set_pose(self.pose())
        self.instance.set_ground((0.0, 1.0, 0.0, 0.0) if ground else None)
        self.scene.update()
        return self.instance.read_ao()

    def trace(self, rays):
        """The same by ray tracing of the body alone."""
        positions, normals = self.character.skin(self.pose())
        offset = 1e-4 * float(np.linalg.norm(self.character.bounds[1] - self.character.bounds[0]))
        return self.nook.trace_ao([(positions, self.character.triangles())], positions, normals, rays=rays, origin_offset=offset)

    def deviation(self, depsgraph):
        """The largest distance in metres between Blender's vertices and the same ones skinned by Nook; None where it has others."""
        points = character.shown_points(self.meshes, depsgraph)
        if points is None:
            return None
        positions, _ = self.character.skin(self.pose())
        return float(np.linalg.norm(poses.moved(poses.Y_UP, points)[self.numbers] - positions, axis=1).max())

    def paint(self, name, values):
        """Writes values of the file's vertices into a colour attribute of the meshes."""
        grey = poses.mean_of_copies(values, self.numbers, self.count)
        first = 0
        for mesh in self.meshes:
            data = mesh.data
            count = len(data.vertices)
            write_colours(data, name, grey[first:first + count])
            first += count

    def follow(self, ground):
        """Paints the pose of now, if it is another one than the last; meshes that are being edited wait."""
        if any(o.data.is_editmode for o in self.meshes):
            return
        now = (ground, self.pose().tobytes())
        if now != self.painted:
            self.painted = now
            self.paint(AO, self.evaluate(ground))

    def is_alive(self):
        return all(name in bpy.data.objects for name in (self.armature_name, *self.mesh_names)) and \
            (any(o.data.is_editmode for o in self.meshes) or self.count == sum(vertex_counts(self.meshes)))


def baked_counts(armature, default):
    """What the bake wrote; a property of a file can hold anything."""
    try:
        return [int(count) for count in armature.get(COUNTS_PROPERTY, default)]
    except (TypeError, ValueError):
        return None


def folder_of(armature):
    """Where the armature's bake is, as the file says; it may have to be confirmed."""
    if FOLDER_PROPERTY not in armature:
        raise Fault(f"the armature {armature.name} has no bake; bake it first")
    return folders.resolved(armature[FOLDER_PROPERTY], f"the armature {armature.name}")


def vertex_counts(meshes):
    return [len(o.data.vertices) for o in meshes]


def write_colours(data, name, grey):
    attribute = data.color_attributes.get(name)
    if attribute is None or attribute.domain != "POINT" or attribute.data_type != "FLOAT_COLOR":
        if attribute is not None:
            data.color_attributes.remove(attribute)
        attribute = data.color_attributes.new(name, "FLOAT_COLOR", "POINT")
    colours = np.ones((len(grey), 4), dtype=np.float32)
    colours[:, :3] = grey[:, None]
    attribute.data.foreach_set("color", colours.ravel())
    data.color_attributes.active_color = data.color_attributes[name]
    data.update_tag()


_shown = {}


def get(armature):
    """The shown character of an armature, or None."""
    found = _shown.get(armature.name)
    if found is not None and not found.is_alive():
        del _shown[armature.name]
        return None
    return found


def show(context, armature, folder):
    """Loads the bake in a confirmed folder and paints the current pose."""
    folders.require_confirmed(str(folder))
    nook = library.load(preferences.of(context).library)
    meshes = character.meshes_of(armature, context.view_layer)
    for name in (MODEL_FILE, CHARACTER_FILE):
        if not (pathlib.Path(folder) / name).is_file():
            raise Fault(f"{pathlib.Path(folder) / name} does not exist; bake the character first")
    try:
        entry = Shown(armature, meshes, folder, nook)
    except nook.NookError as error:
        raise Fault(str(error)) from error
    _shown[armature.name] = entry
    before = armature.get(FOLDER_PROPERTY)
    if isinstance(before, str) and before != str(folder):
        folders.remove_temporary(before)  # the bake that this one replaces
    armature[FOLDER_PROPERTY] = str(folder)
    entry.follow(context.scene.nook.ground)
    return entry


def hide(armature):
    _shown.pop(armature.name, None)


@bpy.app.handlers.persistent
def follow(scene, _depsgraph=None):
    """Paints all shown characters at a new frame, and in a new pose."""
    for name in list(_shown):
        entry = _shown[name]
        if not entry.is_alive():
            del _shown[name]
            continue
        try:
            entry.follow(scene.nook.ground)
        except entry.nook.NookError as error:
            del _shown[name]
            print(f"Nook: {name} is no longer shown: {error}")


@bpy.app.handlers.persistent
def follow_posing(scene, depsgraph=None):
    """The same while an artist poses. A render reads the meshes meanwhile; it has frames of its own."""
    if _shown and not bpy.app.is_job_running("RENDER"):
        follow(scene, depsgraph)


@bpy.app.handlers.persistent
def forget(*_):
    """Another file holds other objects."""
    _shown.clear()


def register():
    bpy.app.handlers.frame_change_post.append(follow)
    bpy.app.handlers.depsgraph_update_post.append(follow_posing)
    bpy.app.handlers.load_pre.append(forget)


def unregister():
    bpy.app.handlers.frame_change_post.remove(follow)
    bpy.app.handlers.depsgraph_update_post.remove(follow_posing)
    bpy.app.handlers.load_pre.remove(forget)
    _shown.clear()
