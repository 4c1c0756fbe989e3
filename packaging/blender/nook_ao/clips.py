"""The actions of a rig, sampled bone by bone."""
import math
import time

import numpy as np

from . import character, glb, stage

# Longer clips are sampled at every second frame, third frame and so on, because bakes read far fewer frames.
MOST_FRAMES = 200
SLICE_S = 0.3


def own_actions(armature):
    """Returns the action in the rig's animation data, and the actions of NLA strips that are not muted."""
    animation = armature.animation_data
    if animation is None:
        return []
    found = [animation.action] if animation.action is not None else []
    found += [s.action for t in animation.nla_tracks if not t.mute for s in t.strips if not s.mute and s.action is not None]
    return list(dict.fromkeys(found))


def fits(action, armature):
    """Returns whether an action moves bones of a rig."""
    for curve in getattr(action, "fcurves", ())[:8]:
        if curve.data_path.startswith("pose.bones["):
            return curve.data_path.split('"')[1] in armature.pose.bones
    return False


def chosen_actions(armature, actions):
    """Returns the actions to export: the rig's own actions, and the ticked actions that fit the rig."""
    own = own_actions(armature)
    return own + [a for a in actions if a.nook_bake and a not in own and fits(a, armature)]


class Clip:
    def __init__(self, name, seconds, matrices):
        self.name, self.seconds, self.matrices = name, seconds, matrices


def frames_of(action):
    first, last = action.frame_range
    step = max(1, math.ceil((last - first) / MOST_FRAMES))
    return [first + step * k for k in range(math.floor((last - first) / step) + 1)]


def sample(armature, action, frames_per_s):
    """Samples an action in time slices. Yields None after each slice, and the clip at the end."""
    frames, matrices = frames_of(action), []
    name = action.name
    while len(matrices) < len(frames):
        begin = time.monotonic()
        with stage.opened(armature) as played:
            played.play(action)
            while len(matrices) < len(frames) and time.monotonic() - begin < SLICE_S:
                played.set_frame(frames[len(matrices)])
                matrices.append(character.pose_matrices(played.evaluated(played.rig)))
        yield None
    yield Clip(name, (np.array(frames) - frames[0]) / frames_per_s, np.array(matrices))


def add_to(file, clip, parents, mirror, node_of_bone):
    """Adds a clip to a file, with three curves per bone: translation, rotation and scale."""
    matrices = mirror @ clip.matrices @ mirror
    times = file.add(clip.seconds.astype(np.float32), bounds=True)
    samplers, channels = [], []
    for bone, parent in enumerate(parents):
        local = matrices[:, bone] if parent < 0 else np.linalg.inv(matrices[:, parent]) @ matrices[:, bone]
        places, turns, sizes = glb.to_turns(local)
        for at in range(1, len(turns)):
            if turns[at] @ turns[at - 1] < 0:
                turns[at] *= -1
        for path, values in (("translation", places), ("rotation", turns), ("scale", sizes)):
            if path == "scale" and np.abs(sizes - 1).max() < 1e-5:
                continue
            if (values == values[0]).all():
                samplers.append({"input": file.add(clip.seconds[:1].astype(np.float32), bounds=True), "output": file.add(values[:1])})
            else:
                samplers.append({"input": times, "output": file.add(values)})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": node_of_bone[bone], "path": path}})
    file.document.setdefault("animations", []).append({"name": clip.name, "samplers": samplers, "channels": channels})
