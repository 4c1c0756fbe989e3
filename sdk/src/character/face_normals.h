// The sides that the vertices of a host's mesh look to by its triangles. Smooth normals may agree on both
// faces of a sharp fold or of a leaf.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/character/host_vertices.h"

namespace nook {

// Returns the mean normal of the triangles of each vertex, weighted by area: unit length, or 0 without a
// triangle. Indices are in range, three for each triangle. If most triangles look away from the host's
// normals, as in mirrored files, all are turned round.
Vector<Vec3> face_normals_of(const HostVertices& host, std::span<const std::uint32_t> indices,
                             Memory* memory);

}  // namespace nook
