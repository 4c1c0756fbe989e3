#include "samples/mannequin/half_edge_mesh.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

namespace nook_samples::mannequin {

HalfEdgeMesh::HalfEdgeMesh(const TriangleMesh& mesh)
    : positions_m_(mesh.positions_m),
      from_(mesh.triangles.size() * 3),
      twin_(from_.size(), kNone),
      leaving_(positions_m_.size(), kNone) {
  std::unordered_map<std::uint64_t, Index> by_ends;
  by_ends.reserve(from_.size());
  for (Index h = 0; h < from_.size(); ++h) {
    from_[h] = mesh.triangles[h / 3][h % 3];
    leaving_[from_[h]] = h;
  }
  for (Index h = 0; h < from_.size(); ++h) {
    const std::uint64_t reversed = std::uint64_t{to(h)} << 32 | from(h);
    if (const auto other = by_ends.find(reversed); other != by_ends.end()) {
      pair(h, other->second);
      by_ends.erase(other);
    } else if (!by_ends.emplace(std::uint64_t{from(h)} << 32 | to(h), h).second) {
      throw std::runtime_error("HalfEdgeMesh: an edge has more than two triangles");
    }
  }
  if (!by_ends.empty()) {
    throw std::runtime_error("HalfEdgeMesh: the mesh is not closed");
  }
}

TriangleMesh HalfEdgeMesh::packed() const {
  TriangleMesh mesh;
  std::vector<Index> renamed(positions_m_.size(), kNone);
  for (Index v = 0; v < positions_m_.size(); ++v) {
    if (leaving_[v] != kNone) {
      renamed[v] = static_cast<Index>(mesh.positions_m.size());
      mesh.positions_m.push_back(positions_m_[v]);
    }
  }
  for (Index h = 0; h < from_.size(); h += 3) {
    if (!is_dead(h)) {
      mesh.triangles.push_back({renamed[from_[h]], renamed[from_[h + 1]], renamed[from_[h + 2]]});
    }
  }
  return mesh;
}

int HalfEdgeMesh::valence(Index v) const {
  int count = 0;
  for_each_leaving(v, [&](Index) { ++count; });
  return count;
}

bool HalfEdgeMesh::are_neighbours(Index a, Index b) const {
  bool found = false;
  for_each_leaving(a, [&](Index h) { found = found || to(h) == b; });
  return found;
}

void HalfEdgeMesh::pair(Index a, Index b) {
  twin_[a] = b;
  twin_[b] = a;
}

void HalfEdgeMesh::split(Index h, const Vec3& middle_m) {
  // Each of the two triangles gives its far half to a new one.
  const Index g = twin_[h];
  const Index end = to(h), far_h = opposite(h), far_g = opposite(g);
  const Index h_next = next(h), g_prev = previous(g);
  const Index h_next_twin = twin_[h_next], g_prev_twin = twin_[g_prev];
  const Index middle = vertex_count();
  const Index a = half_edge_count(), b = a + 3;
  positions_m_.push_back(middle_m);
  leaving_.push_back(h_next);
  // Face a: middle, end, far_h. Face b: end, middle, far_g.
  from_.insert(from_.end(), {middle, end, far_h, end, middle, far_g});
  twin_.resize(from_.size(), kNone);
  from_[h_next] = middle;
  from_[g] = middle;
  leaving_[end] = a + 1;
  pair(a, b);
  pair(a + 1, h_next_twin);
  pair(a + 2, h_next);
  pair(b + 1, g_prev);
  pair(b + 2, g_prev_twin);
}

bool HalfEdgeMesh::flip(Index h) {
  const Index g = twin_[h];
  const Index a = from(h), b = to(h), c = opposite(h), d = opposite(g);
  if (c == d || are_neighbours(c, d)) {
    return false;
  }
  const Index bc = twin_[next(h)], ca = twin_[previous(h)], ad = twin_[next(g)], db = twin_[previous(g)];
  // Face of h becomes d, c, a; face of g becomes c, d, b.
  const Index h1 = next(h), h2 = previous(h), g1 = next(g), g2 = previous(g);
  from_[h] = d;
  from_[h1] = c;
  from_[h2] = a;
  from_[g] = c;
  from_[g1] = d;
  from_[g2] = b;
  pair(h1, ca);
  pair(h2, ad);
  pair(g1, db);
  pair(g2, bc);
  leaving_[a] = h2;
  leaving_[b] = g2;
  leaving_[c] = g;
  leaving_[d] = h;
  return true;
}

bool HalfEdgeMesh::keeps_triangles_upright(Index v, Index except, const Vec3& moved_m,
                                           double longest_edge_m) const {
  bool fine = true;
  for_each_leaving(v, [&](Index h) {
    const Index p = to(h), q = opposite(h);
    fine = fine && glm::length(positions_m_[p] - moved_m) < longest_edge_m;
    if (p == except || q == except) {
      return;
    }
    const Vec3 before = glm::cross(positions_m_[p] - positions_m_[v], positions_m_[q] - positions_m_[v]);
    const Vec3 after = glm::cross(positions_m_[p] - moved_m, positions_m_[q] - moved_m);
    fine = fine && glm::dot(before, after) > 0.4 * glm::length(before) * glm::length(after) &&
           glm::length(after) > 0.0;
  });
  return fine;
}

bool HalfEdgeMesh::collapse(Index h, const Vec3& merged_m, double longest_edge_m) {
  const Index g = twin_[h];
  const Index gone = from(h), kept = to(h), c = opposite(h), d = opposite(g);
  if (c == d || valence(c) < 4 || valence(d) < 4 || valence(gone) + valence(kept) < 7) {
    return false;
  }
  int shared = 0;
  for_each_leaving(gone, [&](Index k) { shared += are_neighbours(kept, to(k)) ? 1 : 0; });
  if (shared != 2 || !keeps_triangles_upright(gone, kept, merged_m, longest_edge_m) ||
      !keeps_triangles_upright(kept, gone, merged_m, longest_edge_m)) {
    return false;
  }
  const Index h1 = twin_[next(h)], h2 = twin_[previous(h)], g1 = twin_[next(g)], g2 = twin_[previous(g)];
  std::vector<Index> moved;
  for_each_leaving(gone, [&](Index k) { moved.push_back(k); });
  for (Index k : moved) {
    from_[k] = kept;
  }
  pair(h1, h2);
  pair(g1, g2);
  for (Index face : {h - h % 3, g - g % 3}) {
    from_[face] = from_[face + 1] = from_[face + 2] = kNone;
  }
  leaving_[gone] = kNone;
  leaving_[kept] = h2;
  leaving_[c] = h1;
  leaving_[d] = g1;
  positions_m_[kept] = merged_m;
  return true;
}

}  // namespace nook_samples::mannequin
