"""Shows the bakes of a file that Blender opens without a window, for example to render it with `blender -b
FILE -a`.

In this mode, nobody can press a button. The add-on therefore reads a bake without asking, but only if the
bake is in the folder of the .blend or below, and if the user trusts the file. Otherwise, it writes to stderr
why the bake is not shown.
"""
import fnmatch
import os
import sys

import bpy

from . import folders, records, shown
from .faults import Fault


def is_trusted():
    """Returns whether the command line or the preferences allow files to run scripts."""
    own = sys.argv[1:sys.argv.index("--")] if "--" in sys.argv else sys.argv[1:]
    flags = [a in ("-y", "--enable-autoexec") for a in own if a in ("-y", "--enable-autoexec", "-Y", "--disable-autoexec")]
    if flags:
        return flags[-1]
    preferences = bpy.context.preferences
    if not preferences.filepaths.use_scripts_auto_execute:
        return False
    folder = os.path.dirname(bpy.data.filepath)
    return not any(fnmatch.fnmatch(folder, each.path) if each.use_glob else (folder + os.sep).startswith(each.path.rstrip(os.sep) + os.sep)
                   for each in preferences.autoexec_paths if each.path)


def refusal(files):
    """Returns why a bake may not be shown without asking, or None if it may."""
    for path in (files.model, files.character):
        inside = records.folder_inside(path)
        if inside is None:
            return f"{path} is not in the folder of {bpy.data.filepath}; move it there, or show it by a script that calls bpy.ops.nook.show()"
    if not is_trusted():
        return "auto-execution is off; start Blender with -y (--enable-autoexec) before the file, or switch it on in the preferences"
    return None


def baked_rigs():
    """Returns the rigs of this file that have a bake. Each has a flag that says whether the bake was shown
    when the file was saved. Files of version 1.0 do not store this flag."""
    found = [(r.rig, r.is_shown) for r in records.every() if r.rig is not None and r.folder]
    return found + [(o, True) for o in bpy.data.objects if o.type == "ARMATURE" and records.FOLDER_PROPERTY in o and records.find(o) is None]


@bpy.app.handlers.persistent
def after_load(*_):
    if not bpy.app.background:
        return
    for rig, was_shown in baked_rigs():
        try:
            files = shown.existing_files(rig)
            reason = refusal(files) if was_shown else "the display was switched off when the file was saved; press Show and save the file again"
            if reason is None:
                folders.confirm(str(files.folder))
                shown.show(bpy.context, rig)
        except Fault as error:
            reason = str(error)
        if reason is not None:
            print(f"Nook: the ambient occlusion of {rig.name} is not shown: {reason}", file=sys.stderr, flush=True)


def register():
    bpy.app.handlers.load_post.append(after_load)


def unregister():
    bpy.app.handlers.load_post.remove(after_load)
