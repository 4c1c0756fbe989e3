"""The panel in the sidebar of the 3D view."""
import bpy

from . import character, shown
from .faults import Fault


class NOOK_PT_panel(bpy.types.Panel):
    bl_label = "Ambient occlusion"
    bl_category = "Nook"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"

    def draw(self, context):
        layout = self.layout
        settings = context.scene.nook
        try:
            armature = character.armature_of(context)
        except Fault:
            layout.label(text="Select a rigged character", icon="INFO")
            return
        layout.label(text=armature.name, icon="ARMATURE_DATA")
        column = layout.column()
        column.prop(settings, "preset")
        column.prop(settings, "poses")
        column.prop(settings, "without")
        column.prop(settings, "folder")
        layout.operator("nook.bake", icon="RENDER_STILL")
        baked = shown.FOLDER_PROPERTY in armature
        column = layout.column()
        column.enabled = baked
        column.prop(settings, "ground")
        column.operator("nook.show", text="Stop showing it" if shown.get(armature) else "Show over the timeline", icon="HIDE_OFF")
        tracing = column.column(align=True)
        tracing.operator("nook.trace", icon="LIGHT")
        tracing.prop(settings, "rays")
        column.operator("nook.report", icon="URL")


def register():
    bpy.utils.register_class(NOOK_PT_panel)


def unregister():
    bpy.utils.unregister_class(NOOK_PT_panel)
