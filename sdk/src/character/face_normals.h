// Uses the triangles of a host's mesh to find the side that each vertex faces. Smooth normals do not show the
// side if both faces have the same normal, as on a sharp fold or a leaf.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/character/host_vertices.h"

namespace nook {

// For each vertex, returns the mean normal of its triangles, weighted by their area. It has unit length, or
// is 0 if the vertex has no triangle. `indices` holds three vertex indices for each triangle; all must be in
// range. If most triangles face away from the host's normals, as in mirrored files, all results are flipped.
Vector<Vec3> face_normals_of(const HostVertices& host, std::span<const std::uint32_t> indices,
                             Memory* memory);

}  // namespace nook
