"""Computes matrices between Blender's spaces and Nook's spaces. It uses only numpy, so that it can be tested
without Blender.

In Blender's world, z is up. In the file and in Nook, y is up. In Nook's rest space, the body is in its bind
pose at the position that the file's root gives it. The matrix to rest space is computed from the vertices, so
it does not depend on how the exporter changes bones.
"""
import numpy as np

from .faults import Fault

Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])
# As a share of the body's size. The rounding of positions in the file is 1e-7 of their length.
REST_TOLERANCE = 1e-4


def moved(matrix, points):
    """Returns points transformed by a 4x4 matrix."""
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def find_rest_matrix(bound, rest):
    """Returns the 4x4 matrix from armature space to Nook's rest space, by least squares. `bound` and `rest`
    are the same points of the bind pose in both spaces."""
    centre = bound.mean(axis=0)
    terms = np.column_stack([bound - centre, np.ones(len(bound))])
    solution, _, rank, _ = np.linalg.lstsq(terms, rest, rcond=1e-9)
    if rank < 4:
        raise Fault("the character is flat in its rest pose, so its position in the exported file cannot be determined; give the character some depth")
    matrix = np.eye(4)
    matrix[:3, :3] = solution[:3].T
    matrix[:3, 3] = solution[3] - matrix[:3, :3] @ centre
    size = np.linalg.norm(np.ptp(rest, axis=0))
    deviation = np.abs(moved(matrix, bound) - rest).max()
    if not deviation <= REST_TOLERANCE * size:
        raise Fault(f"the vertices of the exported file do not match the mesh (they are {deviation:.3g} m apart); bake again after you change the mesh")
    return matrix


def bone_matrices(world, skinning, rest):
    """Returns the 3x4 matrices of the bones from rest space to Nook's world. `world` is the armature's world
    matrix. `skinning` has one 4x4 matrix per bone in armature space."""
    return np.ascontiguousarray((Y_UP @ world @ skinning @ np.linalg.inv(rest))[:, :3], dtype=np.float32)


def mean_of_copies(values, numbers, count, absent=1.0):
    """Converts values of the file's vertices to values of the mesh's vertices. The copies of a vertex are
    averaged. Vertices without a face get `absent`."""
    copies = np.bincount(numbers, minlength=count)
    sums = np.bincount(numbers, weights=values, minlength=count)
    return np.where(copies > 0, sums / np.maximum(copies, 1), absent)
