"""The bodies of the rigs, in metres with y up: joints, vertices with their weights, triangles, and a clip.

A body is a set of closed tubes. Trunk and limbs bend at the joints, so that ambient occlusion changes with the pose.
"""
import collections
import math

import matrix

Joint = collections.namedtuple("Joint", "name parent head turn")
Body = collections.namedtuple("Body", "joints position normal weights triangles keys parts")


class Surface:
    """Vertices and triangles, tube after tube."""

    def __init__(self, is_rigid=False):
        self.position, self.weights, self.triangles = [], [], []
        self.is_rigid = is_rigid  # limbs are a tube for each segment, as in a robot

    def ring(self, centre, across, up, radii, around, weights):
        for a in range(around):
            c, s = math.cos(2 * math.pi * a / around) * radii[0], math.sin(2 * math.pi * a / around) * radii[1]
            self.position.append([centre[i] + across[i] * c + up[i] * s for i in range(3)])
            self.weights.append(weights)

    def tube(self, rings, around, across, up):
        """rings: (centre, (radius across, radius up), {joint: weight}). Triangles face outwards."""
        first, first_triangle = len(self.position), len(self.triangles)
        for centre, radii, weights in rings:
            self.ring(centre, across, up, radii, around, weights)
        for r in range(len(rings) - 1):
            for a in range(around):
                low, next_a = first + r * around, (a + 1) % around
                quad = low + a, low + next_a, low + around + next_a, low + around + a
                self.triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
        for r, flip in ((0, True), (len(rings) - 1, False)):
            centre = len(self.position)
            self.position.append(list(rings[r][0]))
            self.weights.append(rings[r][2])
            for a in range(around):
                edge = first + r * around + a, first + r * around + (a + 1) % around
                self.triangles.append((edge[1], edge[0], centre) if flip else (edge[0], edge[1], centre))
        if self.volume(first_triangle) < 0:
            self.triangles[first_triangle:] = [(a, c, b) for a, b, c in self.triangles[first_triangle:]]

    def volume(self, first_triangle):
        """Six times the volume of the triangles from the first one on."""
        sum_of_six = 0.0
        for t in self.triangles[first_triangle:]:
            a, b, c = (self.position[v] for v in t)
            sum_of_six += sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3))
        return sum_of_six

    def normals(self):
        sums = [[0.0, 0.0, 0.0] for _ in self.position]
        for t in self.triangles:
            a, b, c = (self.position[v] for v in t)
            u, w = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
            n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]]
            for v in t:
                sums[v] = [sums[v][i] + n[i] for i in range(3)]
        return [[x / math.sqrt(sum(y * y for y in n)) for x in n] for n in sums]


def limb(surface, points, joints, radii, around, across, up, rings):
    """A tube along the points, one joint for each segment; weights change evenly about the inner points."""
    if surface.is_rigid:
        for s, joint in enumerate(joints):
            between = [k / rings for k in range(rings + 1)]
            surface.tube([([points[s][i] * (1 - t) + points[s + 1][i] * t for i in range(3)],
                           (radii[s] * (1 - t) + radii[s + 1] * t,) * 2, {joint: 1.0}) for t in between], around, across, up)
        return
    total = []
    for s in range(len(joints)):
        for k in range(rings + (s + 1 == len(joints))):
            t = k / rings
            centre = [points[s][i] * (1 - t) + points[s + 1][i] * t for i in range(3)]
            radius = radii[s] * (1 - t) + radii[s + 1] * t
            near = 0.5 - abs(t - 0.5)  # to the nearer end, as a share of the segment
            share = max(0.0, 0.5 - 1.6 * near)
            other = s + (1 if t > 0.5 else -1)
            weights = {joints[s]: 1.0}
            if share > 0 and 0 <= other < len(joints):
                weights = {joints[s]: 1 - share, joints[other]: share}
            total.append((centre, (radius, radius), weights))
    surface.tube(total, around, across, up)


X, Y, Z = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]


def minus(v):
    return [-x for x in v]


def person_joints():
    """The lower ten and then the upper ten, so that a file can have a skin for each half."""
    table = [("hips", None, (0, 0.95, 0), 10), ("thigh_l", "hips", (0.11, 0.9, 0), 170), ("shin_l", "thigh_l", (0.11, 0.5, 0.01), 175),
             ("foot_l", "shin_l", (0.11, 0.09, 0), 60), ("toe_l", "foot_l", (0.11, 0.04, 0.13), 90),
             ("thigh_r", "hips", (-0.11, 0.9, 0), 170), ("shin_r", "thigh_r", (-0.11, 0.5, 0.01), 175),
             ("foot_r", "shin_r", (-0.11, 0.09, 0), 60), ("toe_r", "foot_r", (-0.11, 0.04, 0.13), 90),
             ("bag", "hips", (0.05, 0.98, 0.15), 40), ("spine", "hips", (0, 1.05, 0), 5), ("chest", "spine", (0, 1.27, 0), -5),
             ("head", "chest", (0, 1.52, 0), 0), ("upper_l", "chest", (0.2, 1.42, 0), -80), ("fore_l", "upper_l", (0.45, 1.42, 0), -85),
             ("hand_l", "fore_l", (0.69, 1.42, 0), -90), ("upper_r", "chest", (-0.2, 1.42, 0), 80),
             ("fore_r", "upper_r", (-0.45, 1.42, 0), 85), ("hand_r", "fore_r", (-0.69, 1.42, 0), 90),
             ("finger_r", "hand_r", (-0.78, 1.42, 0), 95)]
    names = [row[0] for row in table]
    return [Joint(name, names.index(parent) if parent else -1, list(map(float, head)), turn)
            for name, parent, head, turn in table]


def person_surface(is_rigid):
    """Returns the surface and the number of the first vertex of the upper half."""
    s = Surface(is_rigid)
    s.tube([((0, 0.84, 0), (0.10, 0.08), {0: 1.0}), ((0, 0.88, 0), (0.17, 0.12), {0: 1.0}), ((0, 0.97, 0), (0.17, 0.12), {0: 1.0}),
            ((0, 1.06, 0), (0.15, 0.11), {0: 1.0})], 16, X, minus(Z))
    for side, first in ((1, 1), (-1, 5)):
        x = 0.11 * side
        limb(s, [(x, 0.9, 0), (x, 0.5, 0.01), (x, 0.07, 0)], [first, first + 1], [0.085, 0.062, 0.042], 10, X, Z, 6)
        limb(s, [(x, 0.05, -0.06), (x, 0.04, 0.12), (x, 0.03, 0.2)], [first + 2, first + 3], [0.045, 0.04, 0.025], 8, X, Y, 2)
    s.tube([((0.05, 1.03, 0.15), (0.05, 0.03), {9: 1.0}), ((0.05, 0.97, 0.16), (0.06, 0.04), {9: 1.0}),
            ((0.05, 0.9, 0.15), (0.05, 0.03), {9: 1.0})], 8, X, Z)
    upper = len(s.position)
    torso = [(1.02, 0.13, 0.1, 0.0), (1.08, 0.145, 0.105, 0.0), (1.15, 0.15, 0.105, 0.2), (1.22, 0.16, 0.11, 0.45),
             (1.29, 0.175, 0.12, 0.75), (1.37, 0.185, 0.12, 1.0), (1.45, 0.15, 0.1, 1.0), (1.49, 0.08, 0.07, 1.0)]
    s.tube([((0, y, 0), (rx, rz), {10: 1 - w, 11: w} if 0 < w < 1 else {10 if w == 0 else 11: 1.0}) for y, rx, rz, w in torso],
           16, X, minus(Z))
    head = [(1.48, 0.05), (1.55, 0.055), (1.59, 0.085), (1.66, 0.105), (1.73, 0.095), (1.78, 0.05)]
    s.tube([((0, y, 0.01), (r, r), {12: 1.0}) for y, r in head], 12, X, minus(Z))
    limb(s, [(0.15, 1.42, 0), (0.45, 1.42, 0), (0.69, 1.42, 0), (0.83, 1.42, 0)], [13, 14, 15], [0.055, 0.045, 0.035, 0.02], 10, Y, Z, 5)
    limb(s, [(-0.15, 1.42, 0), (-0.45, 1.42, 0), (-0.69, 1.42, 0), (-0.78, 1.42, 0), (-0.86, 1.42, 0)], [16, 17, 18, 19],
         [0.055, 0.045, 0.035, 0.025, 0.015], 10, Z, Y, 5)
    return s, upper


# Degrees about x, y and z of the world for each joint, in the six keys of the clip. The last key is the extreme pose.
PERSON_CLIP = {
    "hips": [(0, 0, 0), (5, 10, 0), (20, 20, 3), (10, -15, 0), (5, 30, -4), (30, 60, 10)],
    "spine": [(0, 0, 0), (10, 5, 0), (25, 10, 5), (20, -10, 0), (-10, 0, 10), (45, 20, 10)],
    "chest": [(0, 0, 0), (5, 5, 0), (15, 10, 0), (10, 20, 0), (-5, -20, 5), (35, -20, 0)],
    "head": [(0, 0, 0), (10, 20, 0), (-20, -30, 5), (15, 30, 0), (20, 0, 10), (30, 40, 10)],
    "upper_l": [(0, 0, 0), (0, -20, -60), (10, -50, -50), (0, -80, -20), (0, 20, -75), (0, -100, -30)],
    "fore_l": [(0, 0, 0), (0, -20, 0), (0, -80, 0), (0, -100, 10), (0, -30, 0), (0, -130, 0)],
    "hand_l": [(0, 0, 0), (0, 0, 20), (0, -20, 10), (0, 0, -30), (0, 0, 0), (0, -40, 20)],
    "upper_r": [(0, 0, 0), (0, 20, 65), (10, 30, 60), (0, 60, 70), (0, 90, 10), (0, 80, 60)],
    "fore_r": [(0, 0, 0), (0, 20, 0), (0, 60, 0), (0, 90, 0), (0, 110, 0), (0, 120, 0)],
    "hand_r": [(0, 0, 0), (0, 0, -20), (0, 20, 0), (0, 0, 30), (0, 30, 0), (0, 40, 0)],
    "finger_r": [(0, 0, 0), (0, 20, 0), (0, 40, 0), (0, 10, 0), (0, 50, 0), (0, 70, 0)],
    "thigh_l": [(0, 0, 0), (-30, 0, 0), (-80, 0, 5), (20, 0, 0), (-40, 0, 15), (-110, 0, 5)],
    "shin_l": [(0, 0, 0), (20, 0, 0), (90, 0, 0), (30, 0, 0), (60, 0, 0), (120, 0, 0)],
    "foot_l": [(0, 0, 0), (10, 0, 0), (-10, 0, 0), (20, 0, 0), (0, 10, 0), (-20, 0, 0)],
    "toe_l": [(0, 0, 0), (-10, 0, 0), (-20, 0, 0), (0, 0, 0), (-30, 0, 0), (-30, 0, 0)],
    "thigh_r": [(0, 0, 0), (20, 0, 0), (-70, 0, -8), (-50, 0, 0), (10, 0, -10), (-90, 0, -12)],
    "shin_r": [(0, 0, 0), (30, 0, 0), (100, 0, 0), (70, 0, 0), (10, 0, 0), (130, 0, 0)],
    "foot_r": [(0, 0, 0), (-10, 0, 0), (0, 0, 0), (-20, 0, 0), (10, 0, 0), (15, 0, 0)],
    "toe_r": [(0, 0, 0), (-20, 0, 0), (0, 0, 0), (-20, 0, 0), (0, 0, 0), (-25, 0, 0)],
    "bag": [(0, 0, 0), (-10, 0, 0), (-30, 0, 0), (10, 0, 0), (0, 0, 10), (-40, 0, 0)],
}


def beast_joints():
    """A quadruped of 18 joints, whose trunk lies along z."""
    table = [("root", None, (0, 0.62, -0.3), 85), ("loin", "root", (0, 0.64, -0.1), 88), ("withers", "loin", (0, 0.65, 0.15), 80),
             ("neck", "withers", (0, 0.72, 0.36), 45), ("skull", "neck", (0, 0.92, 0.5), 100), ("tail_1", "root", (0, 0.64, -0.42), -95),
             ("tail_2", "tail_1", (0, 0.6, -0.58), -110)]
    names = [row[0] for row in table]
    for side, x in (("l", 0.12), ("r", -0.12)):
        for end, z, parent in (("fore", 0.28, "withers"), ("hind", -0.34, "root")):
            for part, y in (("upper", 0.56), ("lower", 0.3), ("paw", 0.06)):
                name = f"{end}_{part}_{side}"
                table.append((name, parent, (x, y, z), 170))
                parent = name
    names = [row[0] for row in table]
    return [Joint(name, names.index(parent) if parent else -1, list(map(float, head)), turn)
            for name, parent, head, turn in table]


def beast_surface():
    s = Surface()
    limb(s, [(0, 0.6, -0.48), (0, 0.64, -0.1), (0, 0.64, 0.15), (0, 0.66, 0.42)], [0, 1, 2], [0.1, 0.15, 0.17, 0.1], 14, X, Y, 5)
    limb(s, [(0, 0.68, 0.34), (0, 0.92, 0.5), (0, 0.9, 0.78)], [3, 4], [0.1, 0.075, 0.04], 10, X, Y, 5)
    limb(s, [(0, 0.64, -0.44), (0, 0.6, -0.58), (0, 0.5, -0.78)], [5, 6], [0.035, 0.025, 0.012], 8, minus(X), Y, 4)
    for first, x, z in ((7, 0.12, 0.28), (10, 0.12, -0.34), (13, -0.12, 0.28), (16, -0.12, -0.34)):
        limb(s, [(x, 0.58, z), (x, 0.3, z), (x, 0.06, z), (x, 0.01, z + 0.03)], [first, first + 1, first + 2],
             [0.075, 0.05, 0.035, 0.04], 10, X, Z, 5)
    return s


def beast_clip():
    clip = {"root": [(0, 0, 0), (5, 5, 0), (-15, 10, 0), (10, 0, 5), (0, -10, 0), (-25, 20, 8)],
            "loin": [(0, 0, 0), (0, 10, 0), (10, 15, 0), (-10, -10, 0), (0, 20, 0), (20, 30, 0)],
            "withers": [(0, 0, 0), (0, 5, 0), (15, 0, 0), (0, -10, 0), (0, 15, 0), (25, 20, 0)],
            "neck": [(0, 0, 0), (20, 10, 0), (50, 0, 0), (-10, 30, 0), (10, -40, 0), (70, 30, 0)],
            "skull": [(0, 0, 0), (-10, 0, 0), (20, 10, 0), (20, 0, 0), (0, -20, 0), (-30, 20, 0)],
            "tail_1": [(0, 0, 0), (20, 10, 0), (-30, 0, 0), (0, 30, 0), (-50, 0, 0), (-60, 30, 0)],
            "tail_2": [(0, 0, 0), (10, 20, 0), (-20, 0, 0), (0, 30, 0), (-30, 0, 0), (-40, 40, 0)]}
    for leg, sign in (("fore_{}_l", 1), ("hind_{}_l", -1), ("fore_{}_r", -1), ("hind_{}_r", 1)):
        clip[leg.format("upper")] = [(x * sign, 0, 0) for x in (0, 25, -20, 40, -30, 60)]
        clip[leg.format("lower")] = [(x, 0, 0) for x in (0, -20, 30, -50, 40, -90)]
        clip[leg.format("paw")] = [(x, 0, 0) for x in (0, 20, -10, 30, -20, 50)]
    return clip


def poses(joints, clip):
    """For each key the matrix of each joint from the rest pose to the posed body, world space."""
    out = []
    for key in range(6):
        matrices = []
        for joint in joints:
            degrees = clip[joint.name][key]
            turn = matrix.chain(*(matrix.rotation(axis, degrees[axis]) for axis in (1, 0, 2)))
            head = joint.head
            own = matrix.chain(matrix.translation(*head), turn, matrix.translation(*minus(head)))
            lift = matrix.translation(0.02 * key, 0.05 * key, -0.03 * key)
            matrices.append(matrix.product(matrices[joint.parent], own) if joint.parent >= 0 else matrix.product(lift, own))
        out.append(matrices)
    return out


def bind_matrix(joint):
    """The joint's world matrix in the rest pose: at its head, with a turn of its own."""
    return matrix.chain(matrix.translation(*joint.head), matrix.rotation(2, joint.turn), matrix.rotation(0, 0.3 * joint.turn))


def person(prop=False, is_rigid=False):
    joints = person_joints()
    surface, upper = person_surface(is_rigid)
    parts = [(0, upper), (upper, len(surface.position))]
    if prop:
        first = len(surface.position)
        grip = {19: 1.0}
        surface.tube([((-0.84, 1.42 + h, 0.0), (r, r), grip) for h, r in ((-0.25, 0.02), (-0.1, 0.03), (0.1, 0.03), (0.3, 0.12), (0.4, 0.08))],
                     10, X, minus(Z))
        parts.append((first, len(surface.position)))
    return Body(joints, surface.position, surface.normals(), surface.weights, surface.triangles, poses(joints, PERSON_CLIP), parts)


def beast():
    joints, surface = beast_joints(), beast_surface()
    return Body(joints, surface.position, surface.normals(), surface.weights, surface.triangles, poses(joints, beast_clip()),
                [(0, len(surface.position))])
