"""The operators: bake, show, ray trace a frame, open the report."""
import contextlib
import pathlib
import tempfile
import webbrowser

import bpy

from . import character, export, library, preferences, shown, tool
from .faults import Fault

PAGE_FILE = "report.html"
# Of the size of the body: what is further away is another pose.
ALLOWED_DEVIATION = 0.01


@contextlib.contextmanager
def object_mode(context):
    """Edits of a mesh reach its data when its mode is left; afterwards the artist is in the same mode again."""
    active = context.view_layer.objects.active
    mode = active.mode if active is not None else "OBJECT"
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)


def error_text(error):
    text = str(error)
    return text[0].upper() + text[1:]


class CommandOperator(bpy.types.Operator):
    """A command of the tool. From the interface it runs beside Blender and Escape ends it; from a script Blender waits."""

    bl_options = {"REGISTER"}

    def begin(self, context):
        """The arguments of the command."""
        raise NotImplementedError

    def finish(self, context):
        """What happens after the command."""
        raise NotImplementedError

    def execute(self, context):
        try:
            run = tool.Run(self.begin(context))
            run.wait()
            run.check()
            self.finish(context)
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        try:
            self._run = tool.Run(self.begin(context))
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._run.cancel()
            self._end(context)
            self.report({"INFO"}, "Nook: cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not self._run.is_done():
            context.workspace.status_text_set(f"Nook: {self._run.last_line}   (Escape ends it)")
            return {"RUNNING_MODAL"}
        self._end(context)
        try:
            self._run.check()
            self.finish(context)
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def cancel(self, _context):
        """Blender ends."""
        self._run.cancel()

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)


class NOOK_OT_bake(CommandOperator):
    """Bake dynamic ambient occlusion of the selected character and show it"""

    bl_idname = "nook.bake"
    bl_label = "Bake ambient occlusion"

    def begin(self, context):
        settings = context.scene.nook
        command = tool.find(preferences.of(context).tool)
        library.load(preferences.of(context).library)  # a bake that cannot be shown is not begun
        armature = character.armature_of(context)
        self._armature_name = armature.name
        folder = bpy.path.abspath(settings.folder) if settings.folder else tempfile.mkdtemp(prefix="nook-")
        self._folder = pathlib.Path(folder)
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise Fault(f"the folder {folder} cannot be made ({error.strerror}); choose another one") from error
        shown.hide(armature)
        glb = self._folder / shown.CHARACTER_FILE
        with object_mode(context):
            armature[character.WITHOUT_PROPERTY] = settings.without
            meshes = character.meshes_of(armature, context.view_layer)
            armature[shown.COUNTS_PROPERTY] = shown.vertex_counts(meshes)
            export.export_character(context, armature, meshes, str(glb), settings.poses != "auto")
        return [command, "bake", "character", str(glb), "-o", str(self._folder / shown.MODEL_FILE), "--preset", settings.preset,
                "--poses", settings.poses]

    def finish(self, context):
        armature = bpy.data.objects.get(self._armature_name)
        if armature is None:
            raise Fault(f"the armature {self._armature_name} is gone; its bake is in {self._folder}")
        entry = shown.show(context, armature, self._folder)
        show_colours(context)
        self._warn_of_other_shapes(context, entry)

    def _warn_of_other_shapes(self, context, entry):
        others = character.has_other_modifiers(entry.meshes)
        if others:
            self.report({"WARNING"}, f"Nook bakes what the armature deforms; these modifiers are not part of it: {', '.join(others)}")
            return
        deviation = entry.deviation(context.evaluated_depsgraph_get())
        size = max(max(o.dimensions) for o in entry.meshes)
        if deviation is not None and deviation > ALLOWED_DEVIATION * size:
            self.report({"WARNING"}, f"The shown body differs from one that is skinned linearly with 4 bones a vertex by {deviation:.3g} m; "
                        "look at shape keys, Preserve Volume, and vertices of many bones")


class NOOK_OT_show(bpy.types.Operator):
    """Show the ambient occlusion of the selected character's bake over the timeline, or stop it"""

    bl_idname = "nook.show"
    bl_label = "Show ambient occlusion"
    bl_options = {"REGISTER"}

    def execute(self, context):
        try:
            armature = character.armature_of(context)
            if shown.get(armature) is not None:
                shown.hide(armature)
                return {"FINISHED"}
            folder = armature.get(shown.FOLDER_PROPERTY)
            if folder is None:
                raise Fault(f"the armature {armature.name} has no bake; bake it first")
            shown.show(context, armature, folder)
            show_colours(context)
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class NOOK_OT_trace(bpy.types.Operator):
    """Ray trace the ambient occlusion of the selected character in this frame, as a second colour attribute to compare with"""

    bl_idname = "nook.trace"
    bl_label = "Ray trace this frame"
    bl_options = {"REGISTER"}

    def execute(self, context):
        try:
            entry = shown_of(context)
            traced = entry.trace(context.scene.nook.rays)
            modelled = entry.evaluate(False)
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        entry.paint(shown.TRACED, traced)
        seen = traced >= 0.01
        error = float(((traced - modelled)[seen] ** 2).mean() ** 0.5) if seen.any() else 0.0
        self.report({"INFO"}, f"Nook: the root of the mean squared error of this frame, over what is seen, is {error:.3f}")
        return {"FINISHED"}


class NOOK_OT_report(CommandOperator):
    """Write the report of the selected character's bake and open it in the browser"""

    bl_idname = "nook.report"
    bl_label = "Open the report"

    def begin(self, context):
        command = tool.find(preferences.of(context).tool)
        armature = character.armature_of(context)
        folder = armature.get(shown.FOLDER_PROPERTY)
        if folder is None or not (pathlib.Path(folder) / shown.MODEL_FILE).is_file():
            raise Fault(f"the armature {armature.name} has no bake; bake it first")
        self._folder = pathlib.Path(folder)
        self._page = self._folder / PAGE_FILE
        return [command, "report", str(self._folder / shown.MODEL_FILE), str(self._folder / shown.CHARACTER_FILE), "-o", str(self._page)]

    def finish(self, _context):
        if not bpy.app.background:
            webbrowser.open(self._page.as_uri())
        self.report({"INFO"}, f"Nook: the report is {self._page}")


def shown_of(context):
    armature = character.armature_of(context)
    entry = shown.get(armature)
    if entry is None:
        raise Fault(f"the ambient occlusion of {armature.name} is not shown; bake it, or press Show")
    return entry


def show_colours(context):
    """Solid views show the active colour attribute without light, so that grey is the ambient occlusion itself."""
    for area in context.screen.areas if context.screen else ():
        if area.type == "VIEW_3D":
            shading = area.spaces.active.shading
            if shading.type == "SOLID":
                shading.light, shading.color_type = "FLAT", "VERTEX"


CLASSES = (NOOK_OT_bake, NOOK_OT_show, NOOK_OT_trace, NOOK_OT_report)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
