"""A separate scene in which copies of a character move. The frame, the pose and the selection of the artist's
scene are thus not changed."""
import contextlib
import math
import random

import bpy

_open = 0


def is_open():
    """Returns whether a stage is open, so that frame changes come from the stage."""
    return _open > 0


def with_holders(items, armature):
    """Returns `items` and the objects between them and the armature, such as an empty in a hand."""
    found = []
    for item in items:
        while item is not None and item != armature and item not in found:
            found.append(item)
            item = item.parent
    return found


class Stage:
    """Copies of an armature and of meshes. References to objects of a stage are valid until the stage is
    closed."""

    def __init__(self, armature, items=()):
        self.scene = bpy.data.scenes.new("Nook stage")
        self.copies = {}
        for item in (armature, *with_holders(items, armature)):
            copy = item.copy()
            copy.hide_viewport = False
            self.copies[item] = copy
            self.scene.collection.objects.link(copy)
        self.rig = self.copies[armature]
        for copy in list(self.copies.values())[1:]:
            self._follow_copies(copy)

    def _follow_copies(self, copy):
        if copy.parent in self.copies:
            kind, bone, inverse = copy.parent_type, copy.parent_bone, copy.matrix_parent_inverse.copy()
            copy.parent = self.copies[copy.parent]
            copy.parent_type, copy.parent_bone, copy.matrix_parent_inverse = kind, bone, inverse
        targets = [t for c in copy.constraints if c.type == "ARMATURE" for t in c.targets]
        for owner in (*copy.modifiers, *copy.constraints, *targets):
            for each in owner.bl_rna.properties:
                if each.type == "POINTER" and not each.is_readonly and getattr(owner, each.identifier) in self.copies:
                    setattr(owner, each.identifier, self.copies[getattr(owner, each.identifier)])

    def play(self, action):
        """Puts the rig into its rest pose and replaces its animation by one action."""
        animation = self.rig.animation_data_create()
        animation.use_nla = False
        self.rest()
        animation.action = action

    def rest(self):
        for bone in self.rig.pose.bones:
            bone.location, bone.scale = (0, 0, 0), (1, 1, 1)
            bone.rotation_quaternion, bone.rotation_euler, bone.rotation_axis_angle = (1, 0, 0, 0), (0, 0, 0), (0, 0, 1, 0)

    def turn_bones(self, seed):
        """Sets a random pose, for rigs without animation. Every bone except the roots is rotated by at most
        30 degrees per axis."""
        self.rig.animation_data_clear()
        self.rest()
        turns = random.Random(seed)
        for bone in self.rig.pose.bones:
            if bone.parent is not None:
                angles = [turns.uniform(-math.pi / 6, math.pi / 6) for _ in range(3)]
                bone.rotation_mode, bone.rotation_euler = "XYZ", angles

    def set_frame(self, frame):
        whole = math.floor(frame)
        self.scene.frame_set(whole, subframe=frame - whole)

    def evaluated(self, copy):
        return copy.evaluated_get(self.scene.view_layers[0].depsgraph)

    def close(self):
        for copy in self.copies.values():
            bpy.data.objects.remove(copy)
        bpy.data.scenes.remove(self.scene)


@contextlib.contextmanager
def opened(armature, items=()):
    global _open
    _open += 1
    stage = Stage(armature, items)
    try:
        yield stage
    finally:
        stage.close()
        _open -= 1
