"""Reads meshes as arrays, in Blender 3.4 as well as in 4.1 and newer."""
import numpy as np


def read(collection, name, kind, width=1):
    values = np.empty(width * len(collection), dtype=kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def corner_normals(mesh):
    """Returns the normals that Blender uses for shading, one for each corner of a face."""
    if hasattr(mesh, "calc_normals_split"):  # until 4.0
        mesh.calc_normals_split()
        return read(mesh.loops, "normal", np.float32, 3)
    return read(mesh.corner_normals, "vector", np.float32, 3)


class Surface:
    """The triangles of a mesh. Has the positions of vertices, and for each corner its vertex, normal and
    UV."""

    def __init__(self, mesh):
        mesh.calc_loop_triangles()
        self.positions = read(mesh.vertices, "co", np.float32, 3).astype(np.float64)
        self.corners = read(mesh.loop_triangles, "loops", np.int32, 3)
        self.materials = read(mesh.loop_triangles, "material_index", np.int32)
        self.vertex_of_corner = read(mesh.loops, "vertex_index", np.int32)
        self.normals = corner_normals(mesh).astype(np.float64)
        layer = mesh.uv_layers.active
        self.uvs = read(layer.data, "uv", np.float32, 2) if layer is not None else None
        self.triangles = self.vertex_of_corner[self.corners]

    def move(self, placed):
        """Transforms the surface into another space. If the matrix mirrors, the vertex order of triangles is
        reversed, so that their outer side stays the same."""
        self.positions = self.positions @ placed[:3, :3].T + placed[:3, 3]
        turned = self.normals @ np.linalg.inv(placed[:3, :3])
        self.normals = turned / np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-30)
        if np.linalg.det(placed[:3, :3]) < 0:
            self.corners, self.triangles = self.corners[:, ::-1], self.triangles[:, ::-1]


def smooth_normals(positions, triangles):
    """Returns unit normals weighted by area, one for each vertex. Vertices at the same position share a
    normal."""
    size = max(float(np.ptp(positions, axis=0).max()), 1e-30)
    _, place = np.unique(np.rint(positions / (1e-6 * size)).astype(np.int64), axis=0, return_inverse=True)
    place = place.ravel()
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    faces = np.cross(b - a, c - a)
    sums = np.zeros((place.max() + 1, 3))
    for k in range(3):
        np.add.at(sums, place[triangles[:, k]], faces)
    normals = sums[place]
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
