#include "sdk/src/character/host_vertices.h"

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

namespace {

// Candidates in the order of their x, so that those near a position are in a short range.
class Finder {
 public:
  // distance is in the host's unit.
  Finder(Candidates candidates, float distance) : sorted_(std::move(candidates)), distance_(distance) {
    std::stable_sort(sorted_.begin(), sorted_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.position.x < b.position.x; });
  }

  // With a normal, the candidate that faces it most among those that lie within the tolerance of the nearest.
  std::uint32_t find(Vec3 position, const Vec3* normal) const {
    const auto first = std::lower_bound(sorted_.begin(), sorted_.end(), position.x - distance_,
                                        [](const Candidate& c, float x) { return c.position.x < x; });
    float nearest = INFINITY;
    for (auto c = first; c != sorted_.end() && c->position.x <= position.x + distance_; ++c)
      nearest = std::min(nearest, length(c->position - position));
    if (!(nearest <= distance_)) return no_vertex;
    // The steps of 16-bit positions, which vertices at one place can differ by.
    const float same_place = nearest + (normal ? distance_ : 0);
    std::uint32_t found = no_vertex;
    float best = -INFINITY;
    for (auto c = first; c != sorted_.end() && c->position.x <= position.x + distance_; ++c) {
      const float distance = length(c->position - position);
      if (distance > same_place) continue;
      // Directions that differ by less than the steps of the model's normals count as the same.
      const float facing = normal ? std::round(20 * dot(c->normal, *normal)) : 0;
      const float score = facing - distance / (distance_ + 1e-30f);
      if (score > best) {
        best = score;
        found = c->file_vertex;
      }
    }
    return found;
  }

 private:
  Candidates sorted_;
  float distance_ = 0;
};

}  // namespace

std::uint32_t match_vertices(const CharacterModel& model, const HostVertices& host,
                             std::span<std::uint32_t> file_vertices, Memory* memory) {
  Candidates candidates = candidates_of(model, host, memory);
  if (candidates.empty()) {
    std::fill(file_vertices.begin(), file_vertices.end(), no_vertex);
    return host.count;
  }
  const Finder finder(std::move(candidates), tolerance_of(model, host));
  std::uint32_t unmatched = 0;
  for (std::uint32_t i = 0; i < host.count; ++i) {
    const Vec3 normal = host.normal.first ? normalised(host.normal[i]) : Vec3{};
    file_vertices[i] = finder.find(host.position[i], host.normal.first ? &normal : nullptr);
    unmatched += file_vertices[i] == no_vertex;
  }
  return unmatched;
}

CharacterModel remapped(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                        Memory* memory) {
  CharacterModel out(memory);
  out = model;
  out.file_to_welded.clear();
  out.file_to_welded.reserve(file_vertices.size());
  for (const std::uint32_t vertex : file_vertices) out.file_to_welded.push_back(model.file_to_welded[vertex]);
  set_primitives(model, file_vertices, out);
  // A rest vertex becomes the first vertex of the host that has its welded vertex, or goes.
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
