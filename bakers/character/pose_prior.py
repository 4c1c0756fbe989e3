#!/usr/bin/env python3
"""Makes pose_prior_table.inl: statistics of human poses from motion capture.

    bakers/character/pose_prior.py FOLDER

FOLDER contains BVH files of the CMU Graphics Lab Motion Capture Database (http://mocap.cs.cmu.edu, free for all
uses, created with funding from NSF EIA-0196217). The files must use the skeleton of Character Creator, whose joints
are named CC_Base_*. The table contains the centres of clusters of poses, and how poses spread around the centres. It
does not contain any pose of the database.

A pose is described by the turns of chest and head and the directions of the limbs, so that it fits any skeleton. The
axes are left, up and forward. The up axes of pelvis, chest and head point upwards when a person stands upright.
"""
import pathlib
import sys

import numpy as np

SAMPLES_PER_SECOND = 8
CENTRES = 64
FACTORS = 16
SCALE = 100  # table values are in hundredths of a radian, or of the length of a unit vector

LEFT, UP, FORWARD = np.eye(3)
LIMBS = [("Upperarm", "Forearm", "chest"), ("Forearm", "Hand", "chest"), ("Hand", "Mid1", "chest"),
         ("Thigh", "Calf", "pelvis"), ("Calf", "Foot", "pelvis"), ("Foot", "ToeBase", "pelvis")]


class Motion:
    """World rotations and positions of the joints of a BVH file. Keys are joint names without the prefix."""

    def __init__(self, path):
        lines = iter(path.read_text().splitlines())
        names, parents, offsets, channels, stack = [], [], [], [], []
        for line in lines:
            word = line.split()
            if not word:
                continue
            if word[0] in ("ROOT", "JOINT"):
                parents.append(stack[-1] if stack else -1)
                stack.append(len(names))
                names.append(word[1].replace("CC_Base_", ""))
                offsets.append(None)
                channels.append([])
            elif word[0] == "End":
                stack.append(None)
            elif word[0] == "OFFSET" and stack[-1] is not None:
                offsets[stack[-1]] = np.array([float(x) for x in word[1:4]])
            elif word[0] == "CHANNELS":
                channels[stack[-1]] = word[2:]
            elif word[0] == "}":
                stack.pop()
            elif word[0] == "MOTION":
                break
        next(lines)
        seconds = float(next(lines).split()[-1])
        frames = np.array([[float(x) for x in line.split()] for line in lines if line.strip()])
        frames = frames[::max(1, round(1 / (SAMPLES_PER_SECOND * seconds)))]
        self.rotation, self.position = {}, {}
        at = 0
        for name, parent, offset, kinds in zip(names, parents, offsets, channels):
            local = np.tile(np.eye(3), (len(frames), 1, 1))
            shift = np.tile(offset, (len(frames), 1))
            for kind in kinds:
                if kind.endswith("rotation"):
                    local = local @ axis_rotation("XYZ".index(kind[0]), np.radians(frames[:, at]))
                else:
                    shift[:, "XYZ".index(kind[0])] = frames[:, at]
                at += 1
            if parent < 0:
                self.rotation[name], self.position[name] = local, shift
            else:
                above = self.rotation[names[parent]]
                self.rotation[name] = above @ local
                self.position[name] = self.position[names[parent]] + np.einsum("tij,tj->ti", above, shift)


def axis_rotation(axis, angle):
    a, b = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.tile(np.eye(3), (len(angle), 1, 1))
    matrix[:, a, a] = matrix[:, b, b] = np.cos(angle)
    matrix[:, b, a] = np.sin(angle)
    matrix[:, a, b] = -np.sin(angle)
    return matrix


def unit(v):
    return v / np.maximum(1e-9, np.linalg.norm(v, axis=-1, keepdims=True))


def lefts(motion):
    """For pelvis, chest and head, returns the world direction that points to the person's left."""
    p = motion.position
    return {"pelvis": unit(p["L_Thigh"] - p["R_Thigh"]), "chest": unit(p["L_Clavicle"] - p["R_Clavicle"]),
            "head": unit(p["L_Eye"] - p["R_Eye"])}


JOINT_OF = {"pelvis": "Hip", "chest": "Spine02", "head": "Head"}


def frame(left, up):
    """Returns rotations whose columns are the axes left, up and forward."""
    up = unit(up - np.sum(up * left, -1, keepdims=True) * left)
    return np.stack([left, up, np.cross(left, up)], -1)


def turn(matrix):
    """Converts rotation matrices to axis times angle."""
    cosine = np.clip((np.trace(matrix, axis1=1, axis2=2) - 1) / 2, -1, 1)
    angle = np.arccos(cosine)
    axis = np.stack([matrix[:, 2, 1] - matrix[:, 1, 2], matrix[:, 0, 2] - matrix[:, 2, 0],
                     matrix[:, 1, 0] - matrix[:, 0, 1]], -1)
    return unit(axis) * angle[:, None]


def features(motion, upright):
    frames = {part: frame(left, np.einsum("tij,j->ti", motion.rotation[JOINT_OF[part]], upright[part]))
              for part, left in lefts(motion).items()}
    inverse = {part: np.swapaxes(f, 1, 2) for part, f in frames.items()}
    columns = [turn(inverse["pelvis"] @ frames["chest"]), turn(inverse["chest"] @ frames["head"])]
    for side in "LR":
        for start, end, part in LIMBS:
            direction = unit(motion.position[f"{side}_{end}"] - motion.position[f"{side}_{start}"])
            columns.append(np.einsum("tij,tj->ti", inverse[part], direction))
    return np.concatenate(columns, 1)


def k_means(points, count, random):
    centres = [points[0]]
    distance = np.full(len(points), np.inf)
    for _ in range(count - 1):  # k-means++: prefers far points, so that rare poses get a centre
        distance = np.minimum(distance, np.sum((points - centres[-1])**2, 1))
        centres.append(points[random.choice(len(points), p=distance / distance.sum())])
    centres = np.array(centres)
    for _ in range(50):
        nearest = np.argmin(((points[:, None] - centres[None])**2).sum(-1), 1)
        centres = np.array([points[nearest == k].mean(0) if np.any(nearest == k) else centres[k] for k in range(count)])
    return centres, nearest


def main():
    motions = {p.stem: Motion(p) for p in sorted(pathlib.Path(sys.argv[1]).glob("*.bvh"))}
    walks = [m for name, m in motions.items() if name.startswith("007") or name in ("002_01", "002_02")]
    # Find the upright direction in the axes of each joint. A walking person is upright on average, so we take the mean
    # of the world's up direction over walks.
    upright = {part: unit(np.mean([np.einsum("tji,j->ti", m.rotation[joint], UP).mean(0) for m in walks], 0))
               for part, joint in JOINT_OF.items()}
    points = np.concatenate([features(m, upright) for m in motions.values()])
    centres, nearest = k_means(points, CENTRES, np.random.default_rng(1))
    rest = points - centres[nearest]
    values, vectors = np.linalg.eigh(rest.T @ rest / len(rest))
    order = np.argsort(values)[::-1][:FACTORS]
    factors = (vectors[:, order] * np.sqrt(values[order])).T
    print(f"{len(points)} poses of {len(motions)} motions; the centres leave {rest.var() / points.var():.2f} of the "
          f"variance, and the factors hold {values[order].sum() / values.sum():.2f} of that")
    # A centre's share is the square root of its number of poses. Most poses stand or walk, so without the square root,
    # other poses would be rare.
    write(centres, factors, np.sqrt(np.bincount(nearest, minlength=CENTRES)), len(points), len(motions))


def write(centres, factors, shares, poses, motions):
    def rows(table):
        return "".join("    {" + ", ".join(str(int(round(x * SCALE))) for x in row) + "},\n" for row in table)
    text = f"""// clang-format off
// Made by pose_prior.py from {motions} motions ({poses} poses) of the CMU Graphics Lab Motion Capture Database,
// http://mocap.cs.cmu.edu, created with funding from NSF EIA-0196217; free for all uses.
constexpr int centre_count = {len(centres)}, factor_count = {len(factors)}, value_count = {centres.shape[1]};
// Values are in hundredths of a radian, or of the length of a unit vector.
constexpr std::int16_t centre[centre_count][value_count] = {{
{rows(centres)}}};
// The probability of a centre is its number here, divided by the sum of all numbers.
constexpr std::uint16_t share[centre_count] = {{
    {", ".join(str(int(round(10 * x))) for x in shares)}}};
// A pose is a centre plus the sum of all factors, each times a standard normal random number.
constexpr std::int16_t factor[factor_count][value_count] = {{
{rows(factors)}}};
// clang-format on
"""
    (pathlib.Path(__file__).parent / "pose_prior_table.inl").write_text(text)


main()
