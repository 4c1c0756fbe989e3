"""The panel in the sidebar of the 3D view."""
import bpy

from . import character, clips, records, shown
from .faults import Fault


def draw_actions(layout, armature):
    """Lists the rig's own actions, which every bake uses, and other actions that fit the rig, with check
    boxes."""
    own = clips.own_actions(armature)
    others = [a for a in bpy.data.actions if a not in own and clips.fits(a, armature)]
    if not own and not others:
        layout.label(text="No actions")
        return
    column = layout.box().column(align=True)
    for action in own:
        column.label(text=action.name, icon="CHECKMARK")
    for action in others:
        column.prop(action, "nook_bake", text=action.name)


class NOOK_PT_panel(bpy.types.Panel):
    bl_label = "Ambient occlusion"
    bl_category = "Nook"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"

    def draw(self, context):
        layout = self.layout
        try:
            armature = character.armature_of(context)
        except Fault:
            layout.label(text="Select a rigged character", icon="INFO")
            return

        def setting(into, name):
            into.prop(records.settings_of(armature, context.scene, name), name)

        layout.label(text=armature.name, icon="ARMATURE_DATA")
        column = layout.column()
        for name in ("preset", "poses", "without", "folder"):
            setting(column, name)
        if records.setting(armature, context.scene, "poses") != "auto":
            draw_actions(layout, armature)
        layout.operator("nook.bake", icon="RENDER_STILL")
        column = layout.column()
        column.enabled = records.has_bake(armature)
        setting(column, "ground")
        column.operator("nook.show", text="Stop showing it" if shown.get(armature) else "Show over the timeline", icon="HIDE_OFF")
        tracing = column.column(align=True)
        tracing.operator("nook.trace", icon="LIGHT")
        setting(tracing, "rays")
        column.operator("nook.report", icon="URL")
        self._draw_words(layout, armature)

    def _draw_words(self, layout, armature):
        """Shows what was measured, and why a character is no longer shown."""
        record, stopped = records.find(armature), shown.why_stopped(armature)
        lines = record.says.splitlines() if record is not None else []
        if lines or stopped:
            box = layout.box().column(align=True)
            for line in lines:
                box.label(text=line)
            if stopped:
                box.label(text=f"Not shown any more: {stopped}", icon="ERROR")


def register():
    bpy.utils.register_class(NOOK_PT_panel)


def unregister():
    bpy.utils.unregister_class(NOOK_PT_panel)
