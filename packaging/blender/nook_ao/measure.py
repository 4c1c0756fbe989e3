"""Measures the error of a bake. It compares the colours with ray tracing of the meshes as Blender evaluates
them, in the poses that differ most from each other."""
import numpy as np

from . import character, clips, poses, shown, stage, surface

POSES, MOST_POINTS, RAYS = 3, 3000, 128
MOST_FRAMES, MOST_ACTIONS, FRAMES_OF_ACTION = 24, 12, 4
VISIBLE = 0.01
# If the error of the colours exceeds the model's own error by more than this, the add-on looks for a reason.
# The noise of the rays is smaller.
ALLOWED = 0.01
# A distance, as a share of the body's size. Points that are farther apart are on different surfaces.
NEAR = 1e-3
SHEAR = 1.02


class Errors:
    """Root mean square errors over the points that are not black in ray tracing."""

    def __init__(self):
        self._sums, self._counts = {}, {}

    def add(self, kind, truth, values):
        seen = truth >= VISIBLE
        self._sums[kind] = self._sums.get(kind, 0.0) + float(((truth - values)[seen] ** 2).sum())
        self._counts[kind] = self._counts.get(kind, 0) + int(seen.sum())

    def __getitem__(self, kind):
        return (self._sums.get(kind, 0.0) / max(self._counts.get(kind, 0), 1)) ** 0.5


class Still:
    """The meshes of a character in one pose, as Blender evaluates them, in the world space of Nook."""

    def __init__(self, entry, pose, evaluated_items):
        self.pose = pose
        positions, normals, colours, triangles, corners, first = [], [], [], [], [], 0
        for evaluated in evaluated_items:
            mesh = evaluated.to_mesh()
            part = surface.Surface(mesh)
            part.move(poses.Y_UP @ character.matrix(evaluated.matrix_world))
            attribute = mesh.attributes.get(shown.AO)
            grey = surface.read(attribute.data, "color", np.float32, 4)[:, 0] if attribute is not None else np.ones(len(part.positions))
            evaluated.to_mesh_clear()
            positions.append(part.positions)
            normals.append(part.normals)
            colours.append(grey)
            triangles.append(part.triangles + first)
            corners.append(part.vertex_of_corner + first)
            first += len(part.positions)
        self.positions, self.normals, self.colours = (np.concatenate(each) for each in (positions, normals, colours))
        self.triangles, self.vertex_of_corner = np.concatenate(triangles), np.concatenate(corners)
        self.used = np.unique(self.triangles)
        self._add_distance(entry)

    def _add_distance(self, entry):
        """Adds the distances between the vertices and the model's vertices, and the normals of the bake."""
        self.same_vertices = len(self.positions) == entry.count
        self.distance, self.bake_normals = np.inf, None
        if self.same_vertices:
            skinned, normals = entry.character.skin(self.pose)
            self.distance = float(np.linalg.norm(self.positions[entry.numbers] - skinned, axis=1).max())
            if self.distance < NEAR * float(np.ptp(self.positions, axis=0).max()):
                self.bake_normals = np.zeros_like(self.positions)
                self.bake_normals[entry.numbers] = normals
        if self.bake_normals is None:
            self.bake_normals = surface.smooth_normals(self.positions, self.triangles)

    def trace(self, entry, points, normals, rays):
        return entry.nook.trace_ao([(self.positions, self.triangles)], points, normals, rays=rays, origin_offset=entry.ray_offset)


def take_still(entry, played, frame):
    """Paints the colours of a pose on the meshes, and then takes the evaluated meshes. Modifiers interpolate
    the colours for the vertices that they add."""
    pose = _rig_pose(entry, played)
    entry.paint(shown.AO, entry.to_vertices(entry.evaluate(pose, False)))
    played.set_frame(frame)  # an update without set_frame would use the pose of the artist's scene
    return Still(entry, pose, [played.evaluated(played.copies[item]) for item in entry.items])


def _rig_pose(entry, played):
    return entry.pose_of(played.evaluated(played.rig))


def candidates(entry, scene, actions):
    """Returns candidate poses: frames of the timeline, frames of actions, and the current pose. Each is
    stored as the way to reach the pose."""
    frames = np.unique(np.linspace(scene.frame_start, scene.frame_end, MOST_FRAMES).round()).tolist()
    found = []
    with stage.opened(entry.armature) as played:
        for frame in (scene.frame_current, *frames):
            played.set_frame(frame)
            found.append((("timeline", None, frame), _rig_pose(entry, played)))
        for action in actions[::max(1, -(-len(actions) // MOST_ACTIONS))]:
            played.play(action)
            for frame in np.linspace(*action.frame_range, FRAMES_OF_ACTION):
                played.set_frame(float(frame))
                found.append((("action", action.name, float(frame)), _rig_pose(entry, played)))
    return found


def farthest(entry, found):
    """Returns the poses that differ most from the rest pose and from each other, judged by the positions of
    some vertices."""
    chosen = np.linspace(0, entry.character.vertex_count - 1, 200).astype(int)

    def places(pose):
        moved = entry.character.skin(pose)[0][chosen].astype(np.float64)
        moved -= moved.mean(axis=0)
        return moved

    rest = places(entry.character.rest_pose())
    all_places = [places(pose) for _, pose in found]
    size = max(float(np.ptp(rest, axis=0).max()), 1e-30)
    distance = np.array([np.linalg.norm(p - rest, axis=1).mean() for p in all_places])
    kept = []
    while len(kept) < POSES:
        at = int(distance.argmax())
        if not distance[at] > 1e-3 * size:
            break
        kept.append(found[at][0])
        distance = np.minimum(distance, [np.linalg.norm(p - all_places[at], axis=1).mean() for p in all_places])
    return kept or [("turned", None, seed) for seed in range(1, POSES)]


def take_pose(entry, way, actions):
    """Takes a still of one pose, on a new stage."""
    kind, name, value = way
    with stage.opened(entry.armature, entry.items) as played:
        if kind == "turned":
            played.turn_bones(value)
        elif kind == "action":
            played.play(next(a for a in actions if a.name == name))
        played.set_frame(value)
        return take_still(entry, played, value)


def chosen_points(count, most, seed):
    return np.arange(count) if count <= most else np.sort(np.random.default_rng(seed).choice(count, most, replace=False))


def directed(which, normals):
    """Returns the indices in `which` whose normals are not zero. A vertex that has only triangles without
    area has a zero normal."""
    return which[np.linalg.norm(normals[which], axis=1) > 0.5]


def add_errors(errors, entry, still, most=MOST_POINTS, rays=RAYS):
    """Traces one still and adds its errors. Yields between the traces."""
    points = directed(still.used, still.bake_normals)
    points = points[chosen_points(len(points), most, 1)]
    truth = still.trace(entry, still.positions[points], still.bake_normals[points], rays)
    errors.add("bake", truth, still.colours[points])
    yield
    corners = np.unique(np.column_stack([still.vertex_of_corner, np.rint(still.normals * 1e3)]), axis=0, return_index=True)[1]
    corners = directed(corners, still.normals)
    corners = corners[chosen_points(len(corners), most, 2)]
    at = still.vertex_of_corner[corners]
    errors.add("blender", still.trace(entry, still.positions[at], still.normals[corners], rays), still.colours[at])
    yield
    positions, normals = entry.character.skin(still.pose)
    vertices = directed(np.unique(entry.numbers, return_index=True)[1], normals)
    vertices = vertices[chosen_points(len(vertices), most, 1)]
    truth = entry.nook.trace_ao([(positions, entry.character.triangles())], positions[vertices], normals[vertices], rays=rays,
                                origin_offset=entry.ray_offset)
    errors.add("model", truth, entry.evaluate(still.pose, False)[vertices])


def shear_of(pose):
    """Returns the largest ratio by which a bone stretches one direction more than another."""
    sizes = np.linalg.svd(np.asarray(pose, dtype=np.float64)[:, :, :3], compute_uv=False)
    return float((sizes[:, 0] / np.maximum(sizes[:, 2], 1e-30)).max())


def reasons(entry, stills):
    """Returns, in words, which properties of the character the model does not contain."""
    armature, found = entry.armature, []
    for item in entry.items:
        name = item.name
        own = character.armature_modifiers(item, armature)
        found += [f"the modifier {m.name} of {name} is off in views" for m in own if not m.show_viewport]
        found += [f"the modifier {m.name} of {name} is off in renders" for m in own if m.show_viewport and not m.show_render]
        found += [f"the modifier {m.name} of {name} preserves volume" for m in own if m.use_deform_preserve_volume]
        found += [f"the modifier {m.name} of {name} uses bone envelopes" for m in own if m.use_bone_envelopes]
        others = [m.name for m in item.modifiers if m not in own and (m.show_viewport or m.show_render)]
        if others:
            found.append(f"{name} has other modifiers ({', '.join(others)})")
        if len(own) > 1:
            found.append(f"{name} has {len(own)} armature modifiers")
        keys = item.data.shape_keys
        if keys is not None and any(k.value != 0 for k in keys.key_blocks[1:]):
            found.append(f"{name} has shape keys")
    if any(b.bbone_segments > 1 for b in armature.data.bones):
        found.append("the rig has bendy bones")
    return found


def text_of(errors, stills, why):
    lines = [f"Error in {len(stills)} poses: {errors['bake']:.3f} with the bake's normals",
             f"and {errors['blender']:.3f} with Blender's; the model's own: {errors['model']:.3f}"]
    if why:
        lines += ["Blender shows the character differently from the bake:", *why]
    return lines


def after_bake(context, entry, actions):
    """Measures a new bake in time slices. Yields None between slices. At the end, yields the lines for the
    panel and the reasons for warnings."""
    ways = farthest(entry, candidates(entry, context.scene, actions))
    yield None
    errors, stills = Errors(), []
    for way in ways:
        stills.append(take_pose(entry, way, actions))
        entry.painted = None
        for _ in add_errors(errors, entry, stills[-1]):
            yield None
        yield None
    size = max(float(np.ptp(stills[0].positions, axis=0).max()), 1e-30)
    apart = max(s.distance for s in stills if np.isfinite(s.distance)) if any(np.isfinite(s.distance) for s in stills) else 0.0
    why = []
    if errors["bake"] > errors["model"] + ALLOWED or apart > 10 * NEAR * size:
        why = reasons(entry, stills) or ["the mesh differs from the mesh that was baked; bake again"]
        if apart > NEAR * size:
            why.append(f"vertices are up to {apart:.3g} m apart")
    if any(shear_of(still.pose) > SHEAR for still in stills):
        why.append("the rig shears or stretches its bones, which a model cannot represent; apply the scale of the rig, or scale evenly")
    yield text_of(errors, stills, why), why
