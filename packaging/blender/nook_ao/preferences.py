"""Stores where the command and the libraries are, and the settings of a rig."""
import bpy

from . import folders

PRESETS = (("draft", "Draft", "About 20 seconds"), ("standard", "Standard", "Up to 5 minutes"), ("production", "Production", "Up to half an hour"))
POSES = (("all", "Generated and actions", "Generated poses, and poses of the character's actions"), ("auto", "Generated", "Only generated poses"),
         ("clips", "Actions", "Only poses of the character's actions"))
OVERRIDABLE = {"LIBRARY_OVERRIDABLE"}


class NookPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    tool: bpy.props.StringProperty(name="Command", subtype="FILE_PATH", description="Path of the command nook. If empty, the command is searched on the search path of the system")
    library: bpy.props.StringProperty(name="Library", subtype="FILE_PATH",
                                      description="libnook_python, or libnook and libnook_bake. If empty, the libraries are loaded from the places where the system installs them")

    def draw(self, _context):
        self.layout.prop(self, "tool")
        self.layout.prop(self, "library")


def confirm_chosen(settings, _context):
    """Called when the user or a script sets the folder, but not when a file is loaded."""
    if settings.folder:
        folders.confirm(settings.folder)


class NookSettings(bpy.types.PropertyGroup):
    """Settings of a rig, and settings of a scene for rigs without their own. A library override keeps its own settings."""

    preset: bpy.props.EnumProperty(name="Preset", items=PRESETS, default="draft", override=OVERRIDABLE, description="How long the bake may take")
    poses: bpy.props.EnumProperty(name="Poses", items=POSES, default="all", override=OVERRIDABLE, description="The poses that the bake learns from")
    without: bpy.props.StringProperty(name="Leave out", default="", override=OVERRIDABLE,
                                      description="Names of objects that are not part of the bake, such as spare weapons, separated by "
                                      "commas; * and ? stand for any text and any character. Simplified copies of meshes (LOD1, LOD2 and so on) "
                                      "are always left out")
    ground: bpy.props.BoolProperty(name="Ground", default=False, override=OVERRIDABLE,
                                   description="If ticked, a floor at height 0 darkens the character from below")
    folder: bpy.props.StringProperty(name="Folder", subtype="DIR_PATH", default="", override=OVERRIDABLE, update=confirm_chosen,
                                     description="The folder for the files of the bake. The files are named after the armature. If empty, a temporary folder is used")
    rays: bpy.props.IntProperty(name="Rays", default=256, min=16, max=16384, override=OVERRIDABLE,
                                   description="Number of rays for each vertex of a traced frame")


class Unregistered:
    """The preferences if the add-on runs from a folder without being installed, as in its tests."""

    tool = ""
    library = ""


def of(context):
    addon = context.preferences.addons.get(__package__)
    return addon.preferences if addon is not None and addon.preferences is not None else Unregistered


def register():
    bpy.utils.register_class(NookPreferences)
    bpy.utils.register_class(NookSettings)
    bpy.types.Object.nook = bpy.props.PointerProperty(type=NookSettings, override=OVERRIDABLE)
    bpy.types.Scene.nook = bpy.props.PointerProperty(type=NookSettings)
    bpy.types.Action.nook_bake = bpy.props.BoolProperty(name="Bake", default=False, description="If ticked, bakes learn from this action if it fits their rig")


def unregister():
    del bpy.types.Action.nook_bake
    del bpy.types.Scene.nook
    del bpy.types.Object.nook
    bpy.utils.unregister_class(NookSettings)
    bpy.utils.unregister_class(NookPreferences)
