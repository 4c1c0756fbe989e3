"""The folders that the add-on reads and writes.

A .blend file keeps the names of folders: where a bake is, and where the next one goes. A file from somebody else must not choose what
is loaded and where is written. So such a folder is used after the user has confirmed it since the file was opened, or has chosen it
since then. Folders that the add-on made for this session are removed with it.
"""
import atexit
import os
import pathlib
import shutil
import tempfile

import bpy

from .faults import Fault

_confirmed = set()
_temporary = []


def resolved(folder, owner):
    """The whole path of a folder that a file names; a property of a file can hold anything."""
    if not isinstance(folder, str) or not folder:
        raise Fault(f"{owner} names no folder (got {folder!r}); bake again")
    if is_relative(folder) and not bpy.data.filepath:
        raise Fault(f"the folder {folder} is relative to the .blend, which is not saved; save it first, or choose a folder by its whole path")
    return os.path.normpath(bpy.path.abspath(as_relative(folder)))


def is_relative(folder):
    return folder.startswith("//") or not os.path.isabs(folder)


def as_relative(folder):
    """A relative path as Blender writes it: from the .blend on, and not from where Blender was started."""
    return folder if folder.startswith("//") or not is_relative(folder) else f"//{folder}"


def confirm(folder):
    """The user, or a script that names the folder, wants it. A relative one is meant wherever the file is saved."""
    _confirmed.add(as_relative(folder) if is_relative(folder) else resolved(folder, "the call"))


def is_confirmed(folder):
    relative = [each for each in _confirmed if each.startswith("//")] if bpy.data.filepath else []
    return folder in _confirmed or folder in [resolved(each, "the user") for each in relative]


def require_confirmed(folder):
    if not is_confirmed(folder):
        raise Fault(f"the folder {printable(folder)} was chosen by this .blend file and is not confirmed yet; press the button in the panel, "
                    "or give the folder in a script: bpy.ops.nook.confirm(folder=...)")


def printable(text):
    """A name that cannot hide what it is: what is not printable becomes a visible escape."""
    return "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in text)


def require_own_files(folder, names):
    """Files that are written must not be links, which lead out of the confirmed folder."""
    for name in names:
        path = pathlib.Path(folder) / name
        if path.is_symlink():
            raise Fault(f"{printable(str(path))} is a symbolic link, which could lead anywhere; remove it, or choose another folder")


def make_temporary():
    folder = tempfile.mkdtemp(prefix="nook-")
    _temporary.append(folder)
    confirm(folder)
    return folder


def remove_temporary(folder):
    """Removes a folder if make_temporary() made it."""
    folder = str(folder)
    if folder in _temporary:
        _temporary.remove(folder)
        _confirmed.discard(folder)
        shutil.rmtree(folder, ignore_errors=True)


def remove_all_temporary():
    for folder in list(_temporary):
        remove_temporary(folder)


@bpy.app.handlers.persistent
def forget(*_):
    """Another file names other folders."""
    _confirmed.clear()


def register():
    bpy.app.handlers.load_pre.append(forget)
    atexit.register(remove_all_temporary)


def unregister():
    bpy.app.handlers.load_pre.remove(forget)
    atexit.unregister(remove_all_temporary)
    remove_all_temporary()
    _confirmed.clear()
