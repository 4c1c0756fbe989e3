"""Records of the baked characters: what a saved scene stores about them, and where their files are.

A record uses a pointer property, because it stays valid when the object is renamed, after an undo, and in a
saved file. A Python reference becomes invalid after an undo.
"""
import os
import pathlib
import re
import uuid

import bpy

from . import folders, vertex_numbers
from .faults import Fault

# The property in which scenes of version 1.0 store the bake's folder, and the name of the files. The files in
# every bake folder have the same names.
FOLDER_PROPERTY, OLD_STEM = "nook_folder", "character"
RESERVED = re.compile(r"^(con|prn|aux|nul|com\d|lpt\d)$", re.IGNORECASE)


class NookPart(bpy.types.PropertyGroup):
    item: bpy.props.PointerProperty(type=bpy.types.Object)
    vertices: bpy.props.IntProperty()


class NookCharacter(bpy.types.PropertyGroup):
    rig: bpy.props.PointerProperty(type=bpy.types.Object)
    parts: bpy.props.CollectionProperty(type=NookPart)
    key: bpy.props.StringProperty(description="The armature that these files belong to")
    folder: bpy.props.StringProperty(subtype="DIR_PATH")
    relative: bpy.props.StringProperty(description="The path of the folder relative to the folder of the .blend file, if it lies inside")
    stem: bpy.props.StringProperty(description="The name of the files without its ending")
    is_shown: bpy.props.BoolProperty()
    says: bpy.props.StringProperty(description="The results that were measured after the bake, line by line")


def every():
    for scene in bpy.data.scenes:
        yield from scene.nook_characters


def find(armature):
    """Returns the record of an armature, or None."""
    return next((r for r in every() if r.rig == armature), None)


def find_key(key):
    return next((r for r in every() if r.key == key), None)


def make(scene, armature):
    record = find(armature)
    if record is None:
        record = scene.nook_characters.add()
        record.rig, record.key = armature, uuid.uuid4().hex
    return record


def remove(key):
    for scene in bpy.data.scenes:
        for at, record in enumerate(scene.nook_characters):
            if record.key == key:
                scene.nook_characters.remove(at)
                return


def set_parts(record, items):
    record.parts.clear()
    for item in items:
        part = record.parts.add()
        part.item, part.vertices = item, len(item.data.vertices)


def to_words(record):
    """Returns the record as text, without pointers."""
    values = {name: getattr(record, name) for name in ("key", "folder", "relative", "stem", "is_shown", "says")}
    parts = [(p.item.name, p.vertices) for p in record.parts if p.item is not None]
    return record.id_data.name, record.rig.name, parts, values


def from_words(words):
    """Restores a record from text if its objects exist and do not have another record."""
    scene_name, rig_name, parts, values = words
    scene, rig = bpy.data.scenes.get(scene_name), bpy.data.objects.get(rig_name)
    items = [bpy.data.objects.get(name) for name, _ in parts]
    if scene is None or rig is None or None in items or find(rig) is not None:
        return
    record = make(scene, rig)
    for name, value in values.items():
        setattr(record, name, value)
    for item, (_, vertices) in zip(items, parts):
        part = record.parts.add()
        part.item, part.vertices = item, vertices


def folder_inside(folder):
    """Returns a folder relative to the folder of the saved .blend. Links are followed. Returns None if the
    folder is not inside."""
    if not bpy.data.filepath:
        return None
    own, other = os.path.realpath(os.path.dirname(bpy.data.filepath)), os.path.realpath(folder)
    return os.path.relpath(other, own) if other == own or other.startswith(own.rstrip(os.sep) + os.sep) else None


class Files:
    """The paths of the files of a character's bake."""

    def __init__(self, folder, stem):
        self.folder, self.stem = pathlib.Path(folder), stem

    @property
    def character(self):
        return self.folder / f"{self.stem}.glb"

    @property
    def model(self):
        return self.folder / f"{self.stem}.nook"

    @property
    def report(self):
        return self.folder / f"{self.stem}.html"


def files_of(armature):
    """Returns the files of an armature's bake, or None if there is no bake. If the bake is inside the
    .blend's folder, it is found relative to the .blend."""
    record, owner = find(armature), f"the armature {armature.name}"
    if record is None or not record.folder:
        return Files(folders.resolved(armature[FOLDER_PROPERTY], owner), OLD_STEM) if FOLDER_PROPERTY in armature else None
    folder = folders.resolved(armature.get(FOLDER_PROPERTY, record.folder), owner)
    if folder == record.folder and record.relative and bpy.data.filepath:
        moved = Files(os.path.normpath(os.path.join(os.path.dirname(bpy.data.filepath), record.relative)), record.stem)
        if moved.model.is_file():
            return moved
    return Files(folder, record.stem)


def has_bake(armature):
    record = find(armature)
    return FOLDER_PROPERTY in armature or (record is not None and bool(record.folder))


def keep_files(record, files):
    record.folder, record.stem = str(files.folder), files.stem
    record.relative = folder_inside(files.folder) or ""


def stem_of(name):
    """Returns a file name, made from `name`, that is valid on every system."""
    stem = re.sub(r'[\x00-\x1f<>:"/\\|?*]', "_", name).rstrip(" .") or "character"
    return f"{stem}_" if RESERVED.match(stem) else stem


def free_files(folder, name, key):
    """Returns files named after the character that already belong to it, or whose names are free."""
    for number in range(1, 1000):
        files = Files(folder, stem_of(name) if number == 1 else f"{stem_of(name)}-{number}")
        owner = vertex_numbers.read_key(files.character)
        if owner == key or not any(os.path.lexists(path) for path in (files.character, files.model)):
            return files
    raise Fault(f"the folder {folder} already has a thousand files with the name {name}; choose another folder")


def setting(armature, scene, name):
    """Returns a setting of the rig, or of the scene if the rig does not have it. Scripts and older files set
    the scene's settings."""
    return getattr(settings_of(armature, scene, name), name)


def settings_of(armature, scene, name):
    return scene.nook if scene.nook.is_property_set(name) and not armature.nook.is_property_set(name) else armature.nook


@bpy.app.handlers.persistent
def before_save(*_):
    """Removes the records of characters that are no longer in a scene, and stores which folders are inside
    the file's folder."""
    for scene in bpy.data.scenes:
        for at in reversed(range(len(scene.nook_characters))):
            record = scene.nook_characters[at]
            if record.rig is None or not record.rig.users_scene:
                scene.nook_characters.remove(at)
            elif record.folder:
                record.relative = folder_inside(record.folder) or record.relative


def register():
    for each in (NookPart, NookCharacter):
        bpy.utils.register_class(each)
    bpy.types.Scene.nook_characters = bpy.props.CollectionProperty(type=NookCharacter)
    bpy.app.handlers.save_pre.append(before_save)


def unregister():
    bpy.app.handlers.save_pre.remove(before_save)
    del bpy.types.Scene.nook_characters
    for each in (NookCharacter, NookPart):
        bpy.utils.unregister_class(each)
