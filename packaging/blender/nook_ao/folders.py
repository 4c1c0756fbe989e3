"""The folders that the add-on reads and writes.

A .blend file stores the names of folders: where a bake is, and where the next bake is written. A file from
somebody else must not decide what is loaded and where files are written. The add-on therefore uses such a
folder only after the user has confirmed or chosen it since the file was opened. Temporary folders that the
add-on made are removed at the end of the session.
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
    """Returns the absolute path of a folder that a file names. A property of a file can have any content."""
    if not isinstance(folder, str) or not folder:
        raise Fault(f"{owner} does not name a folder (got {folder!r}); bake again")
    if is_relative(folder) and not bpy.data.filepath:
        raise Fault(f"the folder {folder} is relative to the .blend file, which has not been saved; save the file first, or choose a folder by its absolute path")
    return os.path.normpath(bpy.path.abspath(as_relative(folder)))


def is_relative(folder):
    return folder.startswith("//") or not os.path.isabs(folder)


def as_relative(folder):
    """Returns a relative path in Blender's form. It is relative to the .blend, and not to the folder in which
    Blender was started."""
    return folder if folder.startswith("//") or not is_relative(folder) else f"//{folder}"


def confirm(folder):
    """Records that the user, or a script that names the folder, allows it. A relative folder stays allowed
    wherever the file is saved."""
    _confirmed.add(as_relative(folder) if is_relative(folder) else resolved(folder, "the call"))


def is_confirmed(folder):
    relative = [each for each in _confirmed if each.startswith("//")] if bpy.data.filepath else []
    return folder in _confirmed or folder in [resolved(each, "the user") for each in relative]


def require_confirmed(folder):
    if not is_confirmed(folder):
        raise Fault(f"the folder {printable(folder)} was chosen by this .blend file and is not confirmed yet; press the button in the panel, "
                    "or give the folder in a script: bpy.ops.nook.confirm(folder=...)")


def printable(text):
    """Returns a name in which unprintable characters are replaced by visible escapes, so that the name cannot
    mislead the user."""
    return "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in text)


def require_own_files(folder, names):
    """Raises a Fault if a file to be written is a link, because a link can lead out of the confirmed
    folder."""
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
    """Removes a folder, but only if make_temporary() made it."""
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
    """Forgets all confirmed folders when another file is opened, because that file names other folders."""
    _confirmed.clear()


def register():
    bpy.app.handlers.load_pre.append(forget)
    atexit.register(remove_all_temporary)


def unregister():
    bpy.app.handlers.load_pre.remove(forget)
    atexit.unregister(remove_all_temporary)
    remove_all_temporary()
    _confirmed.clear()
