"""Matrices between Blender's spaces and Nook's. Plain numpy, so that it can be tested without Blender.

Blender's world has z up; the file and Nook have y up. The rest space of Nook is where the file's root puts the bind-posed
body. The vertices themselves tell the matrix to it, so that it does not depend on what the exporter does to bones.
"""
import numpy as np

from .faults import Fault

Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])
# Of the size of the body: rounding of positions in the file is 1e-7 of their length.
REST_TOLERANCE = 1e-4


def moved(matrix, points):
    """Points times a 4x4 matrix."""
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def find_rest_matrix(bound, rest):
    """The 4x4 matrix from armature space (points of the bind pose) to Nook's rest space (the same points), by least squares."""
    centre = bound.mean(axis=0)
    terms = np.column_stack([bound - centre, np.ones(len(bound))])
    solution, _, rank, _ = np.linalg.lstsq(terms, rest, rcond=1e-9)
    if rank < 4:
        raise Fault("the character is flat in its rest pose, so that its place in the file cannot be found; give it some depth")
    matrix = np.eye(4)
    matrix[:3, :3] = solution[:3].T
    matrix[:3, 3] = solution[3] - matrix[:3, :3] @ centre
    size = np.linalg.norm(np.ptp(rest, axis=0))
    deviation = np.abs(moved(matrix, bound) - rest).max()
    if not deviation <= REST_TOLERANCE * size:
        raise Fault(f"the vertices of the exported file are not those of the mesh ({deviation:.3g} m apart); bake again after a change of the mesh")
    return matrix


def bone_matrices(world, skinning, rest):
    """3x4 matrices from rest space to Nook's world: world is the armature's, skinning one 4x4 matrix a bone in armature space."""
    return np.ascontiguousarray((Y_UP @ world @ skinning @ np.linalg.inv(rest))[:, :3], dtype=np.float32)


def mean_of_copies(values, numbers, count, absent=1.0):
    """Values of the file's vertices as values of the mesh: the mean of a vertex's copies, and `absent` for vertices without a face."""
    copies = np.bincount(numbers, minlength=count)
    sums = np.bincount(numbers, weights=values, minlength=count)
    return np.where(copies > 0, sums / np.maximum(copies, 1), absent)
