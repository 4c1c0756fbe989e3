#include "sdk/src/character/vertex_match.h"

#include <algorithm>
#include <cmath>

namespace nook {
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
