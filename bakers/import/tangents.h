// Normals and tangents of vertices that have none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/surface_mesh.h"

namespace nook::bake {

// Returns normals weighted by area and averaged over vertices at exactly the same position. A vertex without
// a triangle of positive area gets +z.
std::vector<Vec3> smooth_normals(std::span<const Vec3> position,
                                 std::span<const std::array<std::uint32_t, 3>> triangle);

// Returns tangents by the rule of M. Mikkelsen's tangent space (Simulation of Wrinkled Surfaces Revisited,
// 2008), of which this is an own implementation: the tangent of a triangle at a corner is the direction of
// growing u in its plane, projected across the vertex's normal and normalised. A vertex takes the mean over
// its corners, weighted by the corners' angles, of all vertices with equal position, normal and texture
// coordinates, but only of triangles with its own handedness. A vertex that triangles of both handedness
// share takes that with the larger sum of angles. Triangles whose area, or area in texture coordinates, is
// not above 0 do not count; a vertex without others gets an arbitrary tangent across its normal. Adds a
// sentence to warnings for each kind of repair.
std::vector<Tangent> surface_tangents(const SurfaceMesh& mesh, std::vector<std::string>& warnings);

// Returns the tangent across a unit normal that is nearest to a direction, or an arbitrary one for a
// direction along the normal.
Vec3 across_normal(Vec3 normal, Vec3 direction);

}  // namespace nook::bake
