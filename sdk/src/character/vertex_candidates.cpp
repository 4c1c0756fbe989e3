#include "sdk/src/character/vertex_candidates.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sdk/src/core/affine.h"

namespace nook {
namespace {

// Normals go to the space of a mesh by the transpose of the matrix that brings its positions to rest space.
Vec3 normal_in_mesh(const Mat3x4& rest_from_mesh, Vec3 n) {
  const float* m = rest_from_mesh.m;
  return normalised({m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                     m[2] * n.x + m[6] * n.y + m[10] * n.z});
}

void add_primitive(const CharacterModel& model, std::size_t primitive, bool in_rest_space, Candidates& out) {
  const PrimitiveRange& range = model.primitives[primitive];
  const Mat3x4& rest_from_mesh = model.bind.rest_from_mesh[model.bind.primitive_space[primitive]];
  const Affine mesh_from_rest = inverse(to_double(rest_from_mesh));
  for (std::uint32_t v = range.first_vertex; v < range.first_vertex + range.vertex_count; ++v) {
    const std::uint32_t welded = model.file_to_welded[v];
    Candidate candidate{model.rest.position[welded], model.rest.normal[welded], v};
    if (!in_rest_space) {
      candidate.position = transform(mesh_from_rest, candidate.position);
      candidate.normal = normal_in_mesh(rest_from_mesh, candidate.normal);
    }
    out.push_back(candidate);
  }
}

// Metres in rest space.
float diagonal_of(const RestSurface& rest) {
  Vec3 low = rest.position[0], high = low;
  for (const Vec3 p : rest.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

// The largest length that a metre of rest space has in the spaces of the given primitives.
double largest_unit(const CharacterModel& model, const HostVertices& host) {
  if (host.in_rest_space) return 1;
  double largest = 0;
  for (std::size_t p = 0; p < model.primitives.size(); ++p)
    if (host.primitive < 0 || static_cast<std::size_t>(host.primitive) == p) {
      const Mat3x4& matrix = model.bind.rest_from_mesh[model.bind.primitive_space[p]];
      largest = std::max(largest, 1 / std::cbrt(std::abs(determinant(to_double(matrix)))));
    }
  return largest;
}

}  // namespace

Vec3 StridedPoints::operator[](std::size_t index) const {
  Vec3 out;
  std::memcpy(&out, reinterpret_cast<const unsigned char*>(first) + index * stride, sizeof out);
  return out;
}

std::uint16_t space_of(const CharacterModel& model, std::uint32_t file_vertex) {
  const auto after =
      std::upper_bound(model.primitives.begin(), model.primitives.end(), file_vertex,
                       [](std::uint32_t vertex, const PrimitiveRange& p) { return vertex < p.first_vertex; });
  return model.bind.primitive_space[static_cast<std::size_t>(after - model.primitives.begin()) - 1];
}

Candidates candidates_of(const CharacterModel& model, const HostVertices& host, Memory* memory) {
  Candidates candidates(memory);
  for (std::size_t p = 0; p < model.primitives.size(); ++p)
    if (host.primitive < 0 || static_cast<std::size_t>(host.primitive) == p)
      add_primitive(model, p, host.in_rest_space, candidates);
  return candidates;
}

float tolerance_of(const CharacterModel& model, const HostVertices& host) {
  return host.tolerance * diagonal_of(model.rest) * static_cast<float>(largest_unit(model, host));
}

void set_primitives(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                    CharacterModel& out) {
  out.primitives.clear();
  out.bind.primitive_space.clear();
  for (std::uint32_t i = 0; i < file_vertices.size(); ++i) {
    const std::uint16_t space = model.bind.empty() ? std::uint16_t{0} : space_of(model, file_vertices[i]);
    if (i == 0 || (!model.bind.empty() && out.bind.primitive_space.back() != space)) {
      out.primitives.push_back({i, 0});
      if (!model.bind.empty()) out.bind.primitive_space.push_back(space);
    }
    ++out.primitives.back().vertex_count;
  }
}

}  // namespace nook
