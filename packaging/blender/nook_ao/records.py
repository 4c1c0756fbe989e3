"""Which characters are baked: what a saved scene keeps of them, and where their files are.

A pointer to an object survives its renaming, an undo and a saved file; a reference of Python does not survive an undo.
"""
import os
import pathlib
import re
import uuid

import bpy

from . import folders, vertex_numbers
from .faults import Fault

# Where scenes of version 1.0 keep the folder of a bake, whose files are all called alike.
FOLDER_PROPERTY, OLD_STEM = "nook_folder", "character"
RESERVED = re.compile(r"^(con|prn|aux|nul|com\d|lpt\d)$", re.IGNORECASE)


class NookPart(bpy.types.PropertyGroup):
    item: bpy.props.PointerProperty(type=bpy.types.Object)
    vertices: bpy.props.IntProperty()


class NookCharacter(bpy.types.PropertyGroup):
    rig: bpy.props.PointerProperty(type=bpy.types.Object)
    parts: bpy.props.CollectionProperty(type=NookPart)
    key: bpy.props.StringProperty(description="Whose files these are")
    folder: bpy.props.StringProperty(subtype="DIR_PATH")
    relative: bpy.props.StringProperty(description="The folder as seen from that of the .blend, where it is inside")
    stem: bpy.props.StringProperty(description="The name of the files without its ending")
    is_shown: bpy.props.BoolProperty()
    says: bpy.props.StringProperty(description="What was measured after the bake, line by line")


def every():
    for scene in bpy.data.scenes:
        yield from scene.nook_characters


def find(armature):
    """The record of an armature, or None."""
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
    """A record without pointers."""
    values = {name: getattr(record, name) for name in ("key", "folder", "relative", "stem", "is_shown", "says")}
    parts = [(p.item.name, p.vertices) for p in record.parts if p.item is not None]
    return record.id_data.name, record.rig.name, parts, values


def from_words(words):
    """Restores the record if its objects exist and have no other record."""
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
    """A folder relative to the saved .blend's folder; None if it is not inside, with links followed."""
    if not bpy.data.filepath:
        return None
    own, other = os.path.realpath(os.path.dirname(bpy.data.filepath)), os.path.realpath(folder)
    return os.path.relpath(other, own) if other == own or other.startswith(own.rstrip(os.sep) + os.sep) else None


class Files:
    """The files of a character's bake."""

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
    """Where the bake of an armature is; None without one. A folder inside the .blend's folder moves with it."""
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
    """Makes a name valid for a file on every system."""
    stem = re.sub(r'[\x00-\x1f<>:"/\\|?*]', "_", name).rstrip(" .") or "character"
    return f"{stem}_" if RESERVED.match(stem) else stem


def free_files(folder, name, key):
    """Files by the name of the character that are its own, or that nobody has."""
    for number in range(1, 1000):
        files = Files(folder, stem_of(name) if number == 1 else f"{stem_of(name)}-{number}")
        owner = vertex_numbers.read_key(files.character)
        if owner == key or not any(os.path.lexists(path) for path in (files.character, files.model)):
            return files
    raise Fault(f"the folder {folder} has a thousand files of the name {name}; choose another folder")


def setting(armature, scene, name):
    """A setting of the rig, or of the scene if the rig has none; scripts and older files set the scene's."""
    return getattr(settings_of(armature, scene, name), name)


def settings_of(armature, scene, name):
    return scene.nook if scene.nook.is_property_set(name) and not armature.nook.is_property_set(name) else armature.nook


@bpy.app.handlers.persistent
def before_save(*_):
    """Forgets characters that are in no scene any more, and notes which folders are inside the file's folder."""
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
