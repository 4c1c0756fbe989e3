#pragma once

#include "samples/mannequin/triangle_mesh.h"

namespace nook_samples::mannequin {

/// A closed triangle manifold that can be edited in place. Half-edge `3 f + k` leaves corner k of face f.
/// Removed faces stay as dead entries until the mesh is packed.
class HalfEdgeMesh {
 public:
  using Index = std::uint32_t;

  /// Throws std::runtime_error if some edge does not have exactly two triangles.
  explicit HalfEdgeMesh(const TriangleMesh& mesh);

  TriangleMesh packed() const;

  Index half_edge_count() const { return static_cast<Index>(from_.size()); }
  Index vertex_count() const { return static_cast<Index>(positions_m_.size()); }
  bool is_dead(Index h) const { return from_[h] == kNone; }
  bool is_dead_vertex(Index v) const { return leaving_[v] == kNone; }

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index twin(Index h) const { return twin_[h]; }
  Index from(Index h) const { return from_[h]; }
  Index to(Index h) const { return from_[next(h)]; }
  Index opposite(Index h) const { return from_[previous(h)]; }

  const Vec3& position_m(Index v) const { return positions_m_[v]; }
  void move(Index v, const Vec3& position_m) { positions_m_[v] = position_m; }

  /// Calls `visit` with each half-edge that leaves `v`.
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
  /// Turns the edge inside its two triangles. Refuses and changes nothing if the new edge exists already.
  bool flip(Index h);
  /// Merges both ends into one vertex. Refuses if that would break the manifold or turn a triangle over.
  bool collapse(Index h, const Vec3& merged_m, double longest_edge_m);

 private:
  static constexpr Index kNone = ~Index{0};

  bool are_neighbours(Index a, Index b) const;
  void pair(Index a, Index b);
  bool keeps_triangles_upright(Index v, Index except, const Vec3& moved_m, double longest_edge_m) const;

  std::vector<Vec3> positions_m_;
  std::vector<Index> from_, twin_, leaving_;
};

}  // namespace nook_samples::mannequin
