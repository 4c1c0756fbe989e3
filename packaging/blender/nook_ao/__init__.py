"""Nook in Blender. It bakes the ambient occlusion of a rigged character with the command `nook`, shows it
over the timeline, and opens the report for artists."""
bl_info = {
    "name": "Nook: ambient occlusion of characters",
    "author": "the authors of Nook",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "3D view > sidebar > Nook",
    "description": "Bakes dynamic ambient occlusion of a rigged character, and shows it as a colour attribute while the timeline plays",
    "category": "Bake",
}

from . import background, folders, operators, panel, preferences, records, shown  # noqa: E402

PARTS = (folders, preferences, records, operators, panel, shown, background)


def register():
    for part in PARTS:
        part.register()


def unregister():
    for part in reversed(PARTS):
        part.unregister()
