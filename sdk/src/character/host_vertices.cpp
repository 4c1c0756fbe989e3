#include "sdk/src/character/host_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "sdk/src/core/affine.h"

namespace nook {
namespace {

// Transforms a normal from rest space to the mesh's space. Uses the transpose of rest_from_mesh, because
// rest_from_mesh transforms positions in the opposite direction.
Vec3 normal_in_mesh(const Mat3x4& rest_from_mesh, Vec3 n) {
  const float* m = rest_from_mesh.m;
  return normalised({m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                     m[2] * n.x + m[6] * n.y + m[10] * n.z});
}

// Returns the position of a close vertex, bit-exact as in the file. If in_rest_space is set, returns this
// position transformed to rest space.
Vec3 exact_position(const CloseVertex& vertex, const Affine& rest_from_mesh, bool in_rest_space) {
  return in_rest_space ? transform(rest_from_mesh, vertex.mesh_position) : vertex.mesh_position;
}

// Returns a pointer for each welded vertex: to its CloseVertex, or null. Most are null.
Vector<const CloseVertex*> close_vertices(const CharacterModel& model, Memory* memory) {
  Vector<const CloseVertex*> out(model.vertex_count(), nullptr, memory);
  for (const CloseVertex& vertex : model.bind.close) out[vertex.welded] = &vertex;
  return out;
}

Candidate candidate_of(const CharacterModel& model, std::uint32_t file_vertex, std::uint16_t space,
                       const Affine& mesh_from_rest, bool in_rest_space) {
  const Mat3x4& rest_from_mesh = model.bind.rest_from_mesh[space];
  const std::uint32_t welded = model.file_to_welded[file_vertex];
  Candidate out{model.rest.position[welded], model.rest.normal[welded], file_vertex, welded, space};
  if (in_rest_space) return out;
  out.position = transform(mesh_from_rest, out.position);
  out.normal = normal_in_mesh(rest_from_mesh, out.normal);
  return out;
}

// Returns the diagonal of the bounding box in rest space, in metres.
float diagonal_of(const RestSurface& rest) {
  Vec3 low = rest.position[0], high = low;
  for (const Vec3 p : rest.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

bool is_chosen(const HostVertices& host, std::size_t primitive) {
  return host.primitive < 0 || static_cast<std::size_t>(host.primitive) == primitive;
}

// Computes the length that one metre of rest space has in the space of each given primitive. Returns the
// largest one.
double largest_unit(const CharacterModel& model, const HostVertices& host) {
  if (host.in_rest_space) return 1;
  double largest = 0;
  for (std::size_t p = 0; p < model.primitives.size(); ++p)
    if (is_chosen(host, p)) {
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

std::uint16_t HostWeights::joint_at(std::size_t vertex, std::uint32_t influence) const {
  std::uint16_t out;
  const auto* at = reinterpret_cast<const unsigned char*>(joint) + vertex * joint_stride;
  std::memcpy(&out, at + influence * sizeof out, sizeof out);
  return out;
}

float HostWeights::weight_at(std::size_t vertex, std::uint32_t influence) const {
  float out;
  const auto* at = reinterpret_cast<const unsigned char*>(weight) + vertex * weight_stride;
  std::memcpy(&out, at + influence * sizeof out, sizeof out);
  return out;
}

std::uint16_t space_of(const CharacterModel& model, std::uint32_t file_vertex) {
  const auto after =
      std::upper_bound(model.primitives.begin(), model.primitives.end(), file_vertex,
                       [](std::uint32_t vertex, const PrimitiveRange& p) { return vertex < p.first_vertex; });
  return model.bind.primitive_space[static_cast<std::size_t>(after - model.primitives.begin()) - 1];
}

Candidates candidates_of(const CharacterModel& model, const HostVertices& host, Memory* memory) {
  const BindData& bind = model.bind;
  const Vector<const CloseVertex*> close = close_vertices(model, memory);
  // Takes each welded vertex once for each space. At a seam, the file has several vertices for one welded
  // vertex.
  Vector<std::uint32_t> seen_in_space(model.vertex_count(), no_vertex, memory);
  Candidates candidates(memory);
  for (std::size_t p = 0; p < model.primitives.size(); ++p) {
    if (!is_chosen(host, p)) continue;
    const PrimitiveRange& range = model.primitives[p];
    const std::uint16_t space = bind.primitive_space[p];
    const Affine rest_from_mesh = to_double(bind.rest_from_mesh[space]);
    const Affine mesh_from_rest = inverse(rest_from_mesh);
    for (std::uint32_t v = range.first_vertex; v < range.first_vertex + range.vertex_count; ++v) {
      const std::uint32_t welded = model.file_to_welded[v];
      if (std::exchange(seen_in_space[welded], space) == space) continue;
      Candidate candidate = candidate_of(model, v, space, mesh_from_rest, host.in_rest_space);
      const CloseVertex* const exact = close[welded];
      if (exact && exact->space == space)
        candidate.position = exact_position(*exact, rest_from_mesh, host.in_rest_space);
      if (exact && exact->weights.count > 0) candidate.weights = &exact->weights;
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

float diagonal_of(const CharacterModel& model, const HostVertices& host) {
  return diagonal_of(model.rest) * static_cast<float>(largest_unit(model, host));
}

float tolerance_of(const CharacterModel& model, const HostVertices& host) {
  return host.tolerance * diagonal_of(model, host);
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

CharacterModel remapped(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                        Memory* memory) {
  CharacterModel out(memory);
  out = model;
  out.file_to_welded.clear();
  out.file_to_welded.reserve(file_vertices.size());
  for (const std::uint32_t vertex : file_vertices) out.file_to_welded.push_back(model.file_to_welded[vertex]);
  set_primitives(model, file_vertices, out);
  // Each rest vertex is mapped to the first host vertex that has the same welded vertex. If no host vertex
  // has this welded vertex, the rest vertex is dropped.
  Vector<std::uint32_t> first_host(model.vertex_count(), no_vertex, memory);
  for (std::size_t i = out.file_to_welded.size(); i-- > 0;)
    first_host[out.file_to_welded[i]] = static_cast<std::uint32_t>(i);
  out.bind.vertices.clear();
  for (RestVertex vertex : model.bind.vertices) {
    vertex.file_vertex = first_host[model.file_to_welded[vertex.file_vertex]];
    if (vertex.file_vertex != no_vertex) out.bind.vertices.push_back(vertex);
  }
  return out;
}

}  // namespace nook
