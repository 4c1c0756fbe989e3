"""The operators: bake, show, ray trace a frame, open the report."""
import contextlib
import os
import pathlib
import shutil
import tempfile
import time
import webbrowser

import bpy

from . import character, clips, export, folders, library, measure, preferences, records, shown, tool
from .faults import Fault

# How many seconds a command may work before Blender redraws its window.
SLICE_S = 0.1


@contextlib.contextmanager
def object_mode(context):
    """Switches to object mode, because edits of a mesh are written to its data when edit mode is left.
    Afterwards, restores the artist's mode."""
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
    """Returns an error message as a sentence. If the first word is a path or a function, it is not
    capitalised."""
    text = str(error)
    return text[0].upper() + text[1:] if text.split(" ", 1)[0].isalpha() else text


def ask(folder, then):
    """If only the file has chosen the folder, shows a dialog about it and returns True. The dialog calls the
    operator `then`."""
    if folders.is_confirmed(folder) or bpy.app.background:
        return False
    bpy.ops.nook.confirm("INVOKE_DEFAULT", folder=folder, then=then)
    return True


class NOOK_OT_confirm(bpy.types.Operator):
    """Allow the add-on to use a folder that this .blend file names"""

    bl_idname = "nook.confirm"
    bl_label = "Use this folder?"
    bl_options = {"INTERNAL"}

    folder: bpy.props.StringProperty(name="Folder", subtype="DIR_PATH", options={"SKIP_SAVE"})
    then: bpy.props.EnumProperty(items=(("none", "", ""), ("bake", "", ""), ("show", "", ""), ("report", "", "")), default="none",
                                 options={"SKIP_SAVE", "HIDDEN"})

    # What Nook will do with the folder. The dialog shows this to the user.
    USES = {"bake": "Nook will write files named after the armature into this folder:",
            "show": "Nook will load the files of the bake from this folder:",
            "report": "Nook will load the bake from this folder, and write the report into it:", "none": "Nook may read and write in this folder:"}

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self, width=600)

    def draw(self, _context):
        column = self.layout.column()
        column.label(text="The folder is stored in this .blend file; you have not chosen it since you opened the file.", icon="QUESTION")
        column.label(text=self.USES[self.then])
        text = folders.printable(self.folder)
        for at in range(0, len(text), 80):
            column.label(text=text[at:at + 80])

    def execute(self, _context):
        try:
            folders.confirm(self.folder)
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        if self.then != "none":
            try:
                getattr(bpy.ops.nook, self.then)("INVOKE_DEFAULT")
            except RuntimeError as error:  # the error that the operator reported
                self.report({"ERROR"}, str(error).removeprefix("Error: ").strip())
                return {"CANCELLED"}
        return {"FINISHED"}


class CommandOperator(bpy.types.Operator):
    """Work in time slices. If the user starts it, Blender stays usable and Escape cancels the work. If a
    script starts it, Blender waits for the end."""

    bl_options = {"REGISTER"}
    is_kept = False  # whether it is too late to cancel with Escape
    then = ""  # operator that the folder dialog calls, without "nook."

    def folder(self, context):
        """Returns the folder that the command reads or writes, or None for a temporary folder."""
        raise NotImplementedError

    def work(self, context):
        """Does the work. Between slices, yields what it is doing."""
        raise NotImplementedError

    def execute(self, context):
        try:
            for _ in self.work(context):
                pass
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        try:
            folder = self.folder(context)
            if folder is not None and ask(folder, self.then):
                return {"CANCELLED"}
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        self._work = self.work(context)
        first = self._go_on(context)
        if first != {"RUNNING_MODAL"}:
            return first
        self._timer = context.window_manager.event_timer_add(SLICE_S, window=context.window)
        context.window_manager.modal_handler_add(self)
        return first

    def _go_on(self, context):
        """Does one slice of the work."""
        begin = time.monotonic()
        try:
            while time.monotonic() - begin < SLICE_S:
                at = next(self._work)
                if at is tool.WAITING:
                    break
                self._at = at or getattr(self, "_at", "")
        except StopIteration:
            return {"FINISHED"}
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._work.close()
            self._end(context)
            self.report({"INFO"}, "Nook: the bake is kept and was not measured" if self.is_kept else "Nook: cancelled; no file was changed")
            return {"FINISHED"} if self.is_kept else {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        state = self._go_on(context)
        if state == {"RUNNING_MODAL"}:
            context.workspace.status_text_set(f"Nook: {self.progress()}   (Escape ends it)")
        else:
            self._end(context)
        return state

    def progress(self):
        run = getattr(self, "_run", None)
        return run.last_line if run is not None and run.last_line else getattr(self, "_at", "")

    def cancel(self, _context):
        """Called when Blender exits."""
        self._work.close()

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)

    def run_tool(self, arguments):
        """Runs the command `nook`. If the work ends early, the command is ended too."""
        self._run = tool.Run(arguments)
        try:
            while not self._run.is_done():
                yield tool.WAITING
                if bpy.app.background or not hasattr(self, "_timer"):
                    self._run.wait()
        finally:
            self._run.cancel()
        self._run.check()


# Characters that are being baked, by the key of their record. A second bake is refused, because it would
# write the same files.
_baking = set()


@contextlib.contextmanager
def alone(record_key, name):
    if record_key in _baking:
        raise Fault(f"the character {name} is being baked; wait until the bake ends, or press Escape in the window to cancel the bake")
    _baking.add(record_key)
    try:
        yield
    finally:
        _baking.discard(record_key)


@contextlib.contextmanager
def scratch(folder):
    """Makes a temporary folder beside the final files, which are in `folder`. It is removed with its content,
    so that a cancelled bake leaves no files."""
    made = [p for p in (folder, *folder.parents) if not p.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        temporary = pathlib.Path(tempfile.mkdtemp(prefix=".nook-", dir=folder))
    except OSError as error:
        raise Fault(f"the folder {folder} cannot be written ({error.strerror}); choose another one") from error
    try:
        yield temporary
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        for each in made:
            with contextlib.suppress(OSError):
                each.rmdir()  # fails if not empty


class NOOK_OT_bake(CommandOperator):
    """Bake dynamic ambient occlusion of the selected character and show it"""

    bl_idname = "nook.bake"
    bl_label = "Bake ambient occlusion"
    bl_options = {"REGISTER", "UNDO"}
    then = "bake"

    def folder(self, context):
        armature = character.armature_of(context)
        chosen = records.setting(armature, context.scene, "folder")
        return folders.resolved(chosen, f"the armature {armature.name}") if chosen else None

    def work(self, context):
        command = tool.find(preferences.of(context).tool)
        library.load(preferences.of(context).library)  # do not start a bake that cannot be shown
        armature, scene = character.armature_of(context), context.scene
        parts, left_out = character.parts_of(armature, context.view_layer, records.setting(armature, scene, "without"))
        character.check_paintable(armature, parts, bpy.data.scenes)
        preset, learns_from = (records.setting(armature, scene, name) for name in ("preset", "poses"))
        actions = clips.chosen_actions(armature, bpy.data.actions) if learns_from != "auto" else []
        if learns_from == "clips" and not actions:
            raise Fault(f"the armature {armature.name} has no action; give it one, tick one in the panel, or let the bake learn from generated poses")
        chosen = self.folder(context)
        if chosen is not None:
            folders.require_confirmed(chosen)
        folder = pathlib.Path(chosen or folders.make_temporary())
        known = records.find(armature) is not None
        key, name = records.make(scene, armature).key, armature.name
        self.is_kept, names = False, [p.item.name for p in parts]
        self._others = [f"Left out: {item} {reason}" for item, reason in left_out]
        self._others += [f"Part of the bake: {p.item.name} is hidden in the view, but visible in renders" for p in parts if not p.item.visible_get()]
        action_names = [a.name for a in actions]
        try:
            with alone(key, name), scratch(folder) as temporary:
                yield from self._bake(context, temporary, armature, parts, actions, [command, preset, learns_from], key)
                self._keep(context, temporary, folder, key, name, [find_again(p.item, n) for p, n in zip(parts, names)])
        finally:
            if not self.is_kept:
                folders.remove_temporary(folder)
                if not known:
                    records.remove(key)
        if self._others:
            self.report({"INFO"}, "Nook: " + "; ".join(self._others))
        entry = shown.show(context, records.find_key(key).rig)
        show_colours(context)
        yield from self._measure(context, entry, action_names)

    def _bake(self, context, temporary, armature, parts, actions, settings, key):
        """Writes the character and its model into a temporary folder."""
        command, preset, learns_from = settings
        with object_mode(context):
            geometry = export.Geometry(armature, parts)
        rate = context.scene.render.fps / context.scene.render.fps_base
        sampled, names = [], [a.name for a in actions]
        for at, name in enumerate(names):
            yield f"action {at + 1} of {len(names)}"
            rig, action = records.find_key(key).rig if records.find_key(key) else None, bpy.data.actions.get(name)
            if rig is None or action is None:
                raise Fault(f"the armature or the action {name} no longer exists; bake again")
            for clip in clips.sample(rig, action, rate):
                yield None
            sampled.append(clip)
        yield "writing the character"
        glb, model = temporary / "character.glb", temporary / "character.nook"
        glb.write_bytes(export.to_glb(geometry, sampled, key))
        yield from self.run_tool([command, "bake", "character", str(glb), "-o", str(model), "--preset", preset, "--poses", learns_from])

    def _keep(self, context, temporary, folder, key, name, items):
        """Moves both files to their final names, and stores where they are."""
        record = records.find_key(key)
        if record is None:  # an undo removed it
            rig = bpy.data.objects.get(name)
            record = records.make(context.scene, rig) if rig is not None else None
        if record is None or record.rig is None or None in items:
            raise Fault(f"the armature {name} or one of its meshes no longer exists; nothing was written")
        record.key = key
        files = records.free_files(folder, record.rig.name, key)
        try:
            os.replace(temporary / "character.glb", files.character)
            os.replace(temporary / "character.nook", files.model)
        except OSError as error:
            raise Fault(f"the files {files.character} and {files.model} cannot be written ({error.strerror})") from error
        if record.folder and record.folder != str(folder):
            folders.remove_temporary(record.folder)  # the bake that is replaced
        records.keep_files(record, files)
        records.set_parts(record, items)
        record.rig[records.FOLDER_PROPERTY] = str(folder)
        self.is_kept = True

    def _measure(self, context, entry, names):
        """Measures the error of the colours on the meshes that Blender shows."""
        actions = [bpy.data.actions[n] for n in names if n in bpy.data.actions]
        result = None
        try:
            for result in measure.after_bake(context, entry, actions):
                yield "measuring"
        finally:
            entry.painted = None
            if entry.record is not None:
                entry.follow(context.evaluated_depsgraph_get(), records.setting(entry.armature, context.scene, "ground"))
        lines, why = result
        entry.record.says = "\n".join([*lines, *self._others])
        self.report({"INFO"}, "Nook: " + " ".join(lines[:2]))
        if why:
            self.report({"WARNING"}, "Nook: Blender shows the character differently from the bake: " + "; ".join(why))


def find_again(item, name):
    """Finds an object again after other operations of the artist. An undo creates the object again under the
    same name."""
    try:
        return item if item.users_scene else None
    except ReferenceError:
        return bpy.data.objects.get(name)


class NOOK_OT_show(bpy.types.Operator):
    """Show the ambient occlusion of the selected character's bake over the timeline, or stop it"""

    bl_idname = "nook.show"
    bl_label = "Show ambient occlusion"
    bl_options = {"REGISTER", "UNDO"}

    def invoke(self, context, _event):
        try:
            armature = character.armature_of(context)
            if shown.get(armature) is None and ask(str(shown.existing_files(armature).folder), "show"):
                return {"CANCELLED"}
        except Fault:
            pass  # execute() reports it
        return self.execute(context)

    def execute(self, context):
        try:
            armature = character.armature_of(context)
            if shown.get(armature) is not None:
                shown.hide(armature)
                return {"FINISHED"}
            shown.show(context, armature)
            show_colours(context)
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class NOOK_OT_trace(bpy.types.Operator):
    """Ray trace the ambient occlusion of the selected character in this frame, as a second colour attribute to compare with"""

    bl_idname = "nook.trace"
    bl_label = "Ray trace this frame"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            entry = shown_of(context)
            depsgraph = context.evaluated_depsgraph_get()
            pose = entry.pose(depsgraph)
            if pose is None:
                raise Fault(f"this view does not show the armature {entry.armature.name}; show its collection")
            rays = records.setting(entry.armature, context.scene, "rays")
            entry.paint(shown.AO, entry.to_vertices(entry.evaluate(pose, False)))
            entry.painted = None
            context.view_layer.update()
            depsgraph = context.evaluated_depsgraph_get()
            still = measure.Still(entry, pose, [o.evaluated_get(depsgraph) for o in entry.items])
            errors = measure.Errors()
            for _ in measure.add_errors(errors, entry, still, rays=rays):
                pass
        except Fault as error:
            self.report({"ERROR"}, error_text(error))
            return {"CANCELLED"}
        entry.follow(depsgraph, records.setting(entry.armature, context.scene, "ground"))
        entry.paint(shown.TRACED, entry.to_vertices(entry.trace(pose, rays)))
        entry.record.says = "\n".join(measure.text_of(errors, [still], []))
        self.report({"INFO"}, f"Nook: the root mean square error of this frame, over all visible points, is {errors['bake']:.3f} with the bake's "
                    f"normals and {errors['blender']:.3f} with Blender's")
        return {"FINISHED"}


class NOOK_OT_report(CommandOperator):
    """Write the report of the selected character's bake and open it in the browser"""

    bl_idname = "nook.report"
    bl_label = "Open the report"
    then = "report"

    def folder(self, context):
        return str(shown.existing_files(character.armature_of(context)).folder)

    def work(self, context):
        command = tool.find(preferences.of(context).tool)
        armature = character.armature_of(context)
        files = shown.existing_files(armature)
        folders.require_confirmed(str(files.folder))
        if not files.model.is_file():
            raise Fault(f"the file {files.model} of the armature {armature.name} does not exist; bake it first")
        folders.require_own_files(files.folder, (files.report.name,))
        yield from self.run_tool([command, "report", str(files.model), str(files.character), "-o", str(files.report)])
        if not bpy.app.background:
            webbrowser.open(files.report.as_uri())
        self.report({"INFO"}, f"Nook: the report is {files.report}")


def shown_of(context):
    armature = character.armature_of(context)
    entry = shown.get(armature)
    if entry is None:
        raise Fault(f"the ambient occlusion of {armature.name} is not shown; bake it, or press Show")
    return entry


def show_colours(context):
    """Makes solid views show the active colour attribute without light, so that the grey is exactly the
    ambient occlusion."""
    for area in context.screen.areas if context.screen else ():
        if area.type == "VIEW_3D":
            shading = area.spaces.active.shading
            if shading.type == "SOLID":
                shading.light, shading.color_type = "FLAT", "VERTEX"


CLASSES = (NOOK_OT_confirm, NOOK_OT_bake, NOOK_OT_show, NOOK_OT_trace, NOOK_OT_report)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
