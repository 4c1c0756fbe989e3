#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "bakers/mannequin/body_mesh.h"

namespace nook::mannequin {
namespace {

/// A closed triangle manifold that can be edited in place. Half-edge `3 f + k` starts at corner k of face f.
/// Removed faces remain as dead entries. packed() leaves them out.
class HalfEdgeMesh {
 public:
  using Index = std::uint32_t;

  /// Throws std::runtime_error if an edge does not have exactly two triangles.
  explicit HalfEdgeMesh(const TriangleMesh& mesh);

  TriangleMesh packed() const;

  Index half_edge_count() const { return static_cast<Index>(from_.size()); }
  Index vertex_count() const { return static_cast<Index>(positions_m_.size()); }
  bool is_dead(Index h) const { return from_[h] == none; }
  bool is_dead_vertex(Index v) const { return leaving_[v] == none; }

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index twin(Index h) const { return twin_[h]; }
  Index from(Index h) const { return from_[h]; }
  Index to(Index h) const { return from_[next(h)]; }
  Index opposite(Index h) const { return from_[previous(h)]; }

  const Vec3& position_m(Index v) const { return positions_m_[v]; }
  void move(Index v, const Vec3& position_m) { positions_m_[v] = position_m; }

  /// Calls `visit` with each half-edge that starts at `v`.
  template <typename Visit>
  void for_each_leaving(Index v, Visit visit) const {
    const Index first = leaving_[v];
    Index h = first;
    do {
      visit(h);
      h = twin_[previous(h)];
    } while (h != first);
  }
  int valence(Index v) const;

  void split(Index h, const Vec3& middle_m);
  /// Replaces the edge by the other diagonal of its two triangles. If the mesh already has that edge, changes
  /// nothing and returns false.
  bool flip(Index h);
  /// Merges both ends of the edge into one vertex. Changes nothing and returns false if this would break the
  /// manifold, flip a triangle or make an edge longer than `longest_edge_m`.
  bool collapse(Index h, const Vec3& merged_m, double longest_edge_m);

 private:
  static constexpr Index none = ~Index{0};

  bool are_neighbours(Index a, Index b) const;
  void pair(Index a, Index b);
  bool keeps_triangles_upright(Index v, Index except, const Vec3& moved_m, double longest_edge_m) const;

  std::vector<Vec3> positions_m_;
  std::vector<Index> from_, twin_, leaving_;
};

HalfEdgeMesh::HalfEdgeMesh(const TriangleMesh& mesh)
    : positions_m_(mesh.positions_m),
      from_(mesh.triangles.size() * 3),
      twin_(from_.size(), none),
      leaving_(positions_m_.size(), none) {
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
  std::vector<Index> renamed(positions_m_.size(), none);
  for (Index v = 0; v < positions_m_.size(); ++v) {
    if (leaving_[v] != none) {
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
  // Each of the two triangles becomes half as large. The other halves become new triangles.
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
  twin_.resize(from_.size(), none);
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
  // The face of h becomes (d, c, a), and the face of g becomes (c, d, b).
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
    from_[face] = from_[face + 1] = from_[face + 2] = none;
  }
  leaving_[gone] = none;
  leaving_[kept] = h2;
  leaving_[c] = h1;
  leaving_[d] = g1;
  positions_m_[kept] = merged_m;
  return true;
}

// The bounds of Botsch and Kobbelt, relative to the target length. Splitting an edge above the upper bound,
// or collapsing one below the lower bound, brings edges closer to the target length.
constexpr double split_above = 4.0 / 3.0;
constexpr double collapse_below = 4.0 / 5.0;

using Index = HalfEdgeMesh::Index;

class Remesher {
 public:
  Remesher(const TriangleMesh& dense, const BodySdf& sdf, const EdgeLength& edge_length_m)
      : mesh_(dense), sdf_(sdf), edge_length_m_(edge_length_m) {}

  TriangleMesh run(int rounds) {
    // The dense mesh shrinks to a tenth of its vertices. The target length grows in steps, which keeps the
    // triangles well shaped.
    for (double step : {0.5, 0.75, 1.0}) {
      collapse_short_edges(step);
      even_out_valences();
      relax(false);
    }
    for (int round = 0; round < rounds; ++round) {
      split_long_edges();
      collapse_short_edges(1.0);
      even_out_valences();
      relax(true);
    }
    // Valences hardly change any more. The last rounds widen the remaining narrow angles.
    for (int round = 0; round < 4; ++round) {
      open_narrow_angles();
      relax(true);
    }
    open_narrow_angles();
    return mesh_.packed();
  }

 private:
  Vec3 middle_m(Index h) const {
    return (mesh_.position_m(mesh_.from(h)) + mesh_.position_m(mesh_.to(h))) * 0.5;
  }

  double relative_length(Index h) const {
    const double length = glm::length(mesh_.position_m(mesh_.from(h)) - mesh_.position_m(mesh_.to(h)));
    return length / edge_length_m_(middle_m(h));
  }

  bool is_first_half(Index h) const { return !mesh_.is_dead(h) && h < mesh_.twin(h); }

  void split_long_edges() {
    const Index count = mesh_.half_edge_count();
    for (Index h = 0; h < count; ++h) {
      if (is_first_half(h) && relative_length(h) > split_above) {
        mesh_.split(h, sdf_.project(middle_m(h)));
      }
    }
  }

  void collapse_short_edges(double step) {
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      if (is_first_half(h) && relative_length(h) < collapse_below * step) {
        const Vec3 merged = middle_m(h);
        mesh_.collapse(h, merged, split_above * edge_length_m_(merged));
      }
    }
  }

  void even_out_valences() {
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      if (is_first_half(h) && flip_helps(h) && flip_keeps_shape(h)) {
        mesh_.flip(h);
      }
    }
  }

  void open_narrow_angles() {
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      if (is_first_half(h) && flip_opens_angle(h) && flip_keeps_shape(h)) {
        mesh_.flip(h);
      }
    }
  }

  bool flip_opens_angle(Index h) const {
    const Vec3 a = mesh_.position_m(mesh_.from(h)), b = mesh_.position_m(mesh_.to(h));
    const Vec3 c = mesh_.position_m(mesh_.opposite(h)), d = mesh_.position_m(mesh_.opposite(mesh_.twin(h)));
    const double now = std::max(largest_cosine(a, b, c), largest_cosine(b, a, d));
    const double flipped = std::max(largest_cosine(d, c, a), largest_cosine(c, d, b));
    return flipped < now - 1e-6;
  }

  /// Returns the cosine of the triangle's smallest angle.
  static double largest_cosine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = glm::normalize(b - a), bc = glm::normalize(c - b), ca = glm::normalize(a - c);
    return std::max({-glm::dot(ab, ca), -glm::dot(bc, ab), -glm::dot(ca, bc)});
  }

  bool flip_helps(Index h) const {
    const auto excess = [&](Index v, int change) {
      const int e = mesh_.valence(v) + change - 6;
      return e * e;
    };
    const Index a = mesh_.from(h), b = mesh_.to(h), c = mesh_.opposite(h), d = mesh_.opposite(mesh_.twin(h));
    return excess(a, -1) + excess(b, -1) + excess(c, 1) + excess(d, 1) <
           excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0);
  }

  bool flip_keeps_shape(Index h) const {
    const Vec3 a = mesh_.position_m(mesh_.from(h)), b = mesh_.position_m(mesh_.to(h));
    const Vec3 c = mesh_.position_m(mesh_.opposite(h)), d = mesh_.position_m(mesh_.opposite(mesh_.twin(h)));
    const Vec3 before = glm::cross(b - a, c - a) + glm::cross(a - b, d - b);
    const Vec3 one = glm::cross(a - d, c - d), other = glm::cross(b - c, d - c);
    const double min_dot = 0.6 * glm::length(before);
    return glm::dot(one, before) > min_dot * glm::length(one) &&
           glm::dot(other, before) > min_dot * glm::length(other) && glm::length(one) > 0.0 &&
           glm::length(other) > 0.0;
  }

  void relax(bool on_skin) {
    const Index count = mesh_.vertex_count();
    std::vector<Vec3> moved(count);
    for (Index v = 0; v < count; ++v) {
      if (!mesh_.is_dead_vertex(v)) {
        moved[v] = relaxed(v);
      }
    }
    for (Index v = 0; v < count; ++v) {
      if (!mesh_.is_dead_vertex(v)) {
        mesh_.move(v, on_skin ? sdf_.project(moved[v]) : moved[v]);
      }
    }
  }

  // Returns the mean of the centres of the surrounding triangles, weighted by their area relative to the
  // target area. The vertex moves only in its tangent plane, so that the figure does not shrink.
  Vec3 relaxed(Index v) const {
    const Vec3 p = mesh_.position_m(v);
    Vec3 sum(0.0), normal(0.0);
    double weight = 0.0;
    mesh_.for_each_leaving(v, [&](Index h) {
      const Vec3 a = mesh_.position_m(mesh_.to(h)), b = mesh_.position_m(mesh_.opposite(h));
      const Vec3 twice_area = glm::cross(a - p, b - p);
      const Vec3 centre = (p + a + b) / 3.0;
      const double target_m = edge_length_m_(centre);
      const double w = glm::length(twice_area) / (target_m * target_m);
      sum += centre * w;
      normal += twice_area;
      weight += w;
    });
    if (weight <= 0.0 || glm::length(normal) <= 0.0) {
      return p;
    }
    normal = glm::normalize(normal);
    const Vec3 step = sum / weight - p;
    return p + step - normal * glm::dot(step, normal);
  }

  HalfEdgeMesh mesh_;
  const BodySdf& sdf_;
  const EdgeLength& edge_length_m_;
};

}  // namespace

TriangleMesh remesh(const TriangleMesh& dense, const BodySdf& sdf, const EdgeLength& edge_length_m,
                    int rounds) {
  return Remesher(dense, sdf, edge_length_m).run(rounds);
}

}  // namespace nook::mannequin
