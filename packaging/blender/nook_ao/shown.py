"""The characters whose ambient occlusion is shown. Contains the model of each character, and the handlers
that follow the timeline, posing and renders."""
import bpy
import numpy as np

from . import character, folders, library, poses, preferences, records, stage, vertex_numbers
from .faults import Fault

AO, TRACED = "Nook AO", "Nook traced"
# Property in scenes of version 1.0: how many vertices each mesh had at the bake.
COUNTS_PROPERTY = "nook_vertex_counts"
# Property in scenes of version 1.0: which objects the bake left out.
WITHOUT_PROPERTY = "nook_without"


class Shown:
    """A baked character, with everything that is needed to get from its pose in Blender to colours on its
    meshes."""

    def __init__(self, record, files, nook):
        self.key, self.nook, self.painted = record.key, nook, None
        data = files.character.read_bytes()
        self.character = nook.Character(data=data)
        self.model = nook.CharacterModel(files.model.read_bytes())
        if self.model.vertex_count != self.character.vertex_count:
            raise Fault(f"the file {files.model} has {self.model.vertex_count} vertices, but {files.character} has {self.character.vertex_count}; bake again")
        self.numbers = vertex_numbers.read_vertex_numbers(data)
        self.counts = [p.vertices for p in record.parts]
        self.count = sum(self.counts)
        counts = vertex_counts(self.items)
        if self.counts != counts or len(self.numbers) != self.model.vertex_count or self.numbers.max() >= self.count:
            raise Fault(f"the meshes have {counts} vertices, but the bake was made for {self.counts}; bake again after you change the meshes")
        rest, _ = self.character.vertices()
        parts = [character.Part(item, record.rig) for item in self.items]
        self.rest = poses.find_rest_matrix(*self._bind_places(record.rig, parts, rest.astype(np.float64)))
        self.scene = nook.Scene()
        self.instance = self.scene.add_instance(self.model)

    def _bind_places(self, armature, parts, rest):
        """Stores vertices in armature space and in the file. Objects that follow a bone by a constraint may
        have moved since the bake. They are left out if there are other objects."""
        numbers = self.numbers
        deformed = np.repeat([not part.bone for part in parts], self.counts)
        chosen = deformed[numbers] if deformed.any() else np.ones(len(numbers), dtype=bool)
        return character.bind_points(armature, parts)[numbers[chosen]], rest[chosen]

    @property
    def record(self):
        return records.find_key(self.key)

    @property
    def armature(self):
        return self.record.rig

    @property
    def items(self):
        return [p.item for p in self.record.parts]

    def pose_of(self, evaluated):
        """Returns the pose matrices of an evaluated armature."""
        # The bones have the same order in the model and in the file.
        skinning = character.skinning_matrices(evaluated, self.model.bone_names)
        return poses.bone_matrices(character.matrix(evaluated.matrix_world), skinning, self.rest)

    def pose(self, depsgraph=None):
        """Returns the pose in a view or in a render. Returns None if the armature does not exist there."""
        evaluated = self.armature.evaluated_get(depsgraph or bpy.context.evaluated_depsgraph_get())
        return self.pose_of(evaluated) if evaluated.is_evaluated else None

    def evaluate(self, pose, ground):
        """Returns the AO of a pose, one value for each vertex of the file. If `ground` is true, a ground at
        height 0 darkens the body from below."""
        self.instance.set_pose(pose)
        self.instance.set_ground((0.0, 1.0, 0.0, 0.0) if ground else None)
        self.scene.update()
        return self.instance.read_ao()

    @property
    def ray_offset(self):
        return 1e-4 * float(np.linalg.norm(self.character.bounds[1] - self.character.bounds[0]))

    def trace(self, pose, rays):
        """Returns the AO of a pose by ray tracing, where only the body itself occludes."""
        positions, normals = self.character.skin(pose)
        return self.nook.trace_ao([(positions, self.character.triangles())], positions, normals, rays=rays, origin_offset=self.ray_offset)

    def to_vertices(self, values):
        """Converts values of the file's vertices to values of Blender's vertices, one mesh after the
        other."""
        return poses.mean_of_copies(values, self.numbers, self.count)

    def paint(self, name, grey):
        """Writes values of Blender's vertices into a colour attribute of the meshes."""
        first = 0
        for item, count in zip(self.items, self.counts):
            write_colours(item.data, name, grey[first:first + count])
            first += count

    def follow(self, depsgraph, ground):
        """Paints the pose of a view or of a render, if it differs from the last painted pose. Meshes in edit
        mode are not painted until editing ends."""
        if any(o.data.is_editmode for o in self.items):
            return
        pose = self.pose(depsgraph)
        if pose is not None and (ground, pose.tobytes()) != self.painted:
            self.painted = (ground, pose.tobytes())
            self.paint(AO, self.to_vertices(self.evaluate(pose, ground)))

    def what_is_gone(self):
        """Returns why this character can no longer be shown, or None if it can."""
        record = self.record
        if record is None or record.rig is None or any(p.item is None for p in record.parts):
            return "its armature or one of its meshes no longer exists"
        counts = vertex_counts(self.items)
        if counts != self.counts and not any(o.data.is_editmode for o in self.items):
            return f"its meshes have {counts} vertices, but the bake was made for {self.counts}; bake again"
        return None


def vertex_counts(items):
    return [len(o.data.vertices) for o in items]


def write_colours(data, name, grey):
    attribute = data.color_attributes.get(name)
    if attribute is None or attribute.domain != "POINT" or attribute.data_type != "FLOAT_COLOR":
        if attribute is not None:
            data.color_attributes.remove(attribute)
        attribute = data.color_attributes.new(name, "FLOAT_COLOR", "POINT")
    colours = np.ones((len(grey), 4), dtype=np.float32)
    colours[:, :3] = grey[:, None]
    if data.library is None:
        attribute.data.foreach_set("color", colours.ravel())
    else:  # foreach_set silently does not change data of a library
        for element, colour in zip(attribute.data, colours.tolist()):
            element.color = colour
    if not is_rendering() and data.color_attributes.active_color != attribute:
        data.color_attributes.active_color = data.color_attributes[name]
    data.update_tag()


_shown, _stopped = {}, {}
_renders = [False]


def is_rendering():
    return _renders[0] or bpy.app.is_job_running("RENDER")


def get(armature):
    """Returns the shown character of an armature, or None."""
    record = records.find(armature)
    return _shown.get(record.key) if record is not None else None


def why_stopped(armature):
    """Returns why a character is no longer shown, or None."""
    record = records.find(armature)
    return _stopped.get(record.key) if record is not None else None


def record_of_old_bake(context, armature):
    """Makes the record of a bake by version 1.0, which identified meshes by their order."""
    without = armature.get(WITHOUT_PROPERTY, "")
    parts, _ = character.parts_of(armature, context.view_layer, without if isinstance(without, str) else "")
    items = [p.item for p in parts if not p.bone and p.item.visible_get(view_layer=context.view_layer)]
    try:
        counts = [int(count) for count in armature.get(COUNTS_PROPERTY, vertex_counts(items))]
    except (TypeError, ValueError):  # a property of a file can have any content
        counts = []
    if counts != vertex_counts(items):
        raise Fault(f"the meshes have {vertex_counts(items)} vertices, but the bake was made for {counts}; bake again after you change the meshes")
    record = records.make(context.scene, armature)
    records.keep_files(record, records.files_of(armature))
    records.set_parts(record, items)
    return record


def existing_files(armature):
    """Returns where the file says that the armature's bake is. The user may have to confirm the folder."""
    files = records.files_of(armature)
    if files is None:
        raise Fault(f"the armature {armature.name} has no bake; bake it first")
    return files


def show(context, armature):
    """Loads the bake of an armature from a confirmed folder and paints the current pose."""
    files = existing_files(armature)
    folders.require_confirmed(str(files.folder))
    nook = library.load(preferences.of(context).library)
    for path in (files.model, files.character):
        if not path.is_file():
            raise Fault(f"the file {path} does not exist; bake the character first")
    record = records.find(armature)
    if record is None or not record.folder:
        record = record_of_old_bake(context, armature)
    elif vertex_numbers.read_key(files.character) not in (record.key, None):
        raise Fault(f"the file {files.character} belongs to another character; bake this character again")
    if any(p.item is None for p in record.parts):
        raise Fault(f"a mesh that the bake of {armature.name} contains no longer exists; bake again")
    try:
        entry = Shown(record, files, nook)
    except (nook.NookError, OSError) as error:
        raise Fault(str(error)) from error
    _shown[record.key], record.is_shown = entry, True
    _stopped.pop(record.key, None)
    entry.follow(context.evaluated_depsgraph_get(), records.setting(armature, context.scene, "ground"))
    return entry


def hide(armature):
    record = records.find(armature)
    if record is not None:
        _shown.pop(record.key, None)
        record.is_shown = False


def _stop(key, reason):
    entry = _shown.pop(key)
    record = entry.record
    name = record.rig.name if record is not None and record.rig is not None else "a character"
    _stopped[key] = reason
    print(f"Nook: {name} is no longer shown: {reason}")


@bpy.app.handlers.persistent
def follow(scene, depsgraph=None):
    """Paints all shown characters at a new frame, and in a new pose.

    A render and every view evaluate the scene separately. The meshes follow the rig of the evaluation that
    calls this. While a render runs, views do not paint.
    """
    if not _shown or depsgraph is None or stage.is_open() or (is_rendering() and depsgraph.mode != "RENDER"):
        return
    for key in list(_shown):
        entry = _shown[key]
        if entry.record is None:
            continue  # an undo removed the armature; a redo can restore it
        gone = entry.what_is_gone()
        if gone is not None:
            _stop(key, gone)
            continue
        try:
            entry.follow(depsgraph, records.setting(entry.armature, scene, "ground"))
        except entry.nook.NookError as error:
            _stop(key, str(error))


@bpy.app.handlers.persistent
def begin_render(*_):
    _renders[0] = True


@bpy.app.handlers.persistent
def end_render(*_):
    _renders[0] = False


_before_undo = {}


@bpy.app.handlers.persistent
def remember(*_):
    """Remembers the records that an undo may remove although their files still exist. They are stored by
    object names, because an undo creates the objects again."""
    _before_undo.clear()
    for key in _shown:
        record = records.find_key(key)
        if record is not None and record.rig is not None:
            _before_undo[key] = records.to_words(record)


@bpy.app.handlers.persistent
def repaint(*_):
    """Restores records and paints again after an undo. The bake is still on disk, but the meshes have old
    colours."""
    for key, words in _before_undo.items():
        if records.find_key(key) is None:
            records.from_words(words)
    for entry in _shown.values():
        entry.painted = None


@bpy.app.handlers.persistent
def forget(*_):
    """Forgets all shown characters when another file is opened, because that file has other objects."""
    _shown.clear()
    _stopped.clear()
    end_render()


HANDLERS = (("frame_change_post", follow), ("depsgraph_update_post", follow), ("render_init", begin_render), ("render_complete", end_render),
            ("render_cancel", end_render), ("undo_pre", remember), ("redo_pre", remember),
            ("undo_post", repaint), ("redo_post", repaint), ("load_pre", forget))


def register():
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister():
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).remove(function)
    forget()
