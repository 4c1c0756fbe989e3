// Which vertices at one place belong to faces that look opposite ways, as on the two sides of a card.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake {

// Vertices that share a place, and the triangles between them.
struct PlacedVertices {
  std::span<const Vec3> position;        // one a vertex
  std::span<const std::uint32_t> place;  // the same: equal numbers, equal places; 0 and up
  std::size_t place_count = 0;
  std::span<const std::array<std::uint32_t, 3>> triangle;
};

// For each vertex the side of its place that it lies on: 0 for nearly all, 1 and up where faces at one place
// look opposite ways. Vertices at one place whose faces meet at an edge form a sheet, so that the tip of a
// cone is one sheet however its faces split it; over an edge of more than two faces each goes on to the one
// at the smallest angle, and no sheet folds back on itself. Two sheets are opposite where their
// area-weighted normals are more than 135 degrees apart. A place with opposite sheets is divided between the
// two that are furthest apart, each other sheet going to the nearer one, until no side holds opposite sheets.
// The order of vertices and triangles decides nothing but which side is 0. A place where more than 256
// corners of triangles meet is left whole, which bounds the work on hostile input.
std::vector<std::uint32_t> sides_of_vertices(const PlacedVertices& mesh);

}  // namespace nook::bake
