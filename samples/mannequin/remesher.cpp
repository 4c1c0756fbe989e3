#include "samples/mannequin/remesher.h"

#include <algorithm>
#include <cmath>

#include "samples/mannequin/half_edge_mesh.h"

namespace nook_samples::mannequin {
namespace {

// Botsch and Kobbelt's bounds: splitting above and collapsing below them brings an edge nearer to the target
// length.
constexpr double kSplitAbove = 4.0 / 3.0;
constexpr double kCollapseBelow = 4.0 / 5.0;

using Index = HalfEdgeMesh::Index;

class Remesher {
 public:
  Remesher(const TriangleMesh& dense, const BodySdf& sdf, const EdgeLength& edge_length_m)
      : mesh_(dense), sdf_(sdf), edge_length_m_(edge_length_m) {}

  TriangleMesh run(int rounds) {
    // Collapsing in growing steps keeps the triangles fair while the dense mesh shrinks by an order of
    // magnitude.
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
    // The valences have settled, and the last rounds open the narrow angles that are left.
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
      if (is_first_half(h) && relative_length(h) > kSplitAbove) {
        mesh_.split(h, sdf_.project(middle_m(h)));
      }
    }
  }

  void collapse_short_edges(double step) {
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      if (is_first_half(h) && relative_length(h) < kCollapseBelow * step) {
        const Vec3 merged = middle_m(h);
        mesh_.collapse(h, merged, kSplitAbove * edge_length_m_(merged));
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

  /// The cosine of the triangle's narrowest angle.
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

  // The mean of the surrounding triangles' centres, weighted by their area over the target area, kept in the
  // tangent plane so that the figure does not shrink.
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

}  // namespace nook_samples::mannequin
