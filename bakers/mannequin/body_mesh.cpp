#include "bakers/mannequin/body_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "bakers/mannequin/bones.h"
#include "bakers/mannequin/shape_primitives.h"

namespace nook::mannequin {

std::vector<Vec3> area_weighted_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions_m.size(), Vec3(0.0));
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions_m[t[0]];
    const Vec3 twice_area = glm::cross(mesh.positions_m[t[1]] - a, mesh.positions_m[t[2]] - a);
    for (std::uint32_t v : t) {
      normals[v] += twice_area;
    }
  }
  for (Vec3& n : normals) {
    n = glm::normalize(n);
  }
  return normals;
}

std::vector<std::vector<std::uint32_t>> vertex_neighbours(const TriangleMesh& mesh) {
  // On a closed mesh, each edge occurs once in each direction. So we add only one end per edge of a triangle.
  std::vector<std::vector<std::uint32_t>> neighbours(mesh.positions_m.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
    }
  }
  return neighbours;
}

namespace {

struct Corner {
  int x, y, z;
};

Corner operator+(const Corner& a, const Corner& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

std::uint64_t key_of(const Corner& c) {
  constexpr int offset = 1 << 15;
  const auto pack = [](int v) { return static_cast<std::uint64_t>(v + offset); };
  return pack(c.x) << 32 | pack(c.y) << 16 | pack(c.z);
}

class Marcher {
 public:
  Marcher(const BodySdf& sdf, double cell_m) : sdf_(sdf), cell_m_(cell_m) {}

  TriangleMesh run() {
    // Starts with a cube of 2^9 cells per side around the figure. Subdivides it to single cells where the
    // skin may pass through.
    visit({-256, -16, -256}, 512);
    return std::move(mesh_);
  }

 private:
  // The six tetrahedra share the cube's diagonal. Neighbouring cubes split their common face along the same
  // diagonal.
  static constexpr Corner tetrahedra[6][3] = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}};

  Vec3 position_m(const Corner& c) const { return Vec3(c.x, c.y, c.z) * cell_m_; }

  double value_at(const Corner& c) {
    const auto [entry, is_new] = values_m_.try_emplace(key_of(c), 0.0);
    if (is_new) {
      // A corner exactly on the skin would produce triangles without area.
      const double d = sdf_.distance(position_m(c));
      const double min_distance_m = 0.02 * cell_m_;
      entry->second = std::abs(d) < min_distance_m ? (d < 0.0 ? -min_distance_m : min_distance_m) : d;
    }
    return entry->second;
  }

  void visit(const Corner& low, int size) {
    if (size == 1) {
      for (const auto& steps : tetrahedra) {
        const Corner second = low + steps[0];
        const Corner third = second + steps[1];
        march({low, second, third, third + steps[2]});
      }
      return;
    }
    const int half = size / 2;
    const Vec3 centre_m = position_m(low + Corner{half, half, half});
    // The cube's half diagonal needs a margin, because the distance is an estimate.
    constexpr double margin = 1.8;
    if (std::abs(sdf_.distance(centre_m)) > margin * std::sqrt(3.0) * half * cell_m_ && size < 64) {
      return;
    }
    for (int child = 0; child < 8; ++child) {
      visit(low + Corner{(child & 1) * half, (child >> 1 & 1) * half, (child >> 2) * half}, half);
    }
  }

  std::uint32_t crossing(const Corner& inside, const Corner& outside) {
    const bool ordered = key_of(inside) < key_of(outside);
    const Corner& first = ordered ? inside : outside;
    const Corner& second = ordered ? outside : inside;
    const Corner step = {second.x - first.x, second.y - first.y, second.z - first.z};
    const auto direction = static_cast<std::uint64_t>((step.x + 1) * 9 + (step.y + 1) * 3 + step.z + 1);
    const auto [entry, is_new] = crossings_.try_emplace(key_of(first) << 5 | direction, 0U);
    if (is_new) {
      const double a = value_at(first), b = value_at(second);
      entry->second = static_cast<std::uint32_t>(mesh_.positions_m.size());
      mesh_.positions_m.push_back(glm::mix(position_m(first), position_m(second), a / (a - b)));
    }
    return entry->second;
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Vec3& outwards) {
    const Vec3& p = mesh_.positions_m[a];
    const Vec3 normal = glm::cross(mesh_.positions_m[b] - p, mesh_.positions_m[c] - p);
    if (glm::dot(normal, outwards) < 0.0) {
      std::swap(b, c);
    }
    mesh_.triangles.push_back({a, b, c});
  }

  void march(const std::array<Corner, 4>& corners) {
    std::vector<Corner>& in = inside_;
    std::vector<Corner>& out = outside_;
    in.clear();
    out.clear();
    Vec3 outwards(0.0);
    for (const Corner& c : corners) {
      (value_at(c) < 0.0 ? in : out).push_back(c);
    }
    if (in.empty() || out.empty()) {
      return;
    }
    for (const Corner& c : out) {
      outwards += position_m(c) / static_cast<double>(out.size());
    }
    for (const Corner& c : in) {
      outwards -= position_m(c) / static_cast<double>(in.size());
    }
    // Compute the crossings in separate statements, because compilers differ in the order in which they
    // evaluate function arguments.
    if (in.size() == 2) {
      const std::uint32_t a = crossing(in[0], out[0]);
      const std::uint32_t b = crossing(in[0], out[1]);
      const std::uint32_t c = crossing(in[1], out[1]);
      const std::uint32_t d = crossing(in[1], out[0]);
      add_triangle(a, b, c, outwards);
      add_triangle(a, c, d, outwards);
      return;
    }
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = in.size() == 1 ? crossing(in[0], out[k]) : crossing(in[k], out[0]);
    }
    add_triangle(t[0], t[1], t[2], outwards);
  }

  const BodySdf& sdf_;
  double cell_m_;
  std::unordered_map<std::uint64_t, double> values_m_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
  std::vector<Corner> inside_, outside_;
  TriangleMesh mesh_;
};

/// Polygonises the skin by marching tetrahedra on a uniform grid. The mesh is dense and irregular, but it is
/// always a closed manifold.
TriangleMesh march_tetrahedra(const BodySdf& sdf, double cell_m) {
  return Marcher(sdf, cell_m).run();
}

// The cells are small enough to keep the gaps between the fingers open.
constexpr double finest_cell_m = 0.0060;
constexpr int rounds = 7;

double target_edge_m(const Vec3& point_m) {
  static const ArmFrame arm = left_arm_frame();
  const Vec3 p(std::abs(point_m.x), point_m.y, point_m.z);
  double edge_m = 0.0268;
  // Limbs get shorter edges than the trunk, because they are thinner and need rings of vertices at the joints
  // to bend.
  const double along_arm_m = glm::dot(p - arm.shoulder_m, arm.along);
  const double off_arm_m = glm::length(p - arm.shoulder_m - arm.along * along_arm_m);
  if (off_arm_m < 0.12 && along_arm_m > 0.0) {
    edge_m = glm::mix(edge_m, 0.0218, ramp(along_arm_m, 0.0, 0.10));
    const double past_wrist_m = glm::dot(p - arm.wrist_m, arm.along);
    edge_m = glm::mix(edge_m, 0.0105, ramp(past_wrist_m, -0.10, 0.010));
    edge_m = glm::mix(edge_m, 0.0066, ramp(past_wrist_m, 0.020, 0.075));
    // The thumb branches off the palm sideways.
    const double thumb =
        ramp(glm::dot(p - arm.wrist_m, arm.forward), 0.025, 0.045) * ramp(past_wrist_m, 0.0, 0.03);
    edge_m = glm::mix(edge_m, 0.0068, thumb);
  }
  edge_m = glm::mix(edge_m, 0.0165, ramp(p.y, 1.42, 1.58));
  edge_m =
      glm::mix(edge_m, 0.0088, ramp(p.y, 1.51, 1.54) * ramp(p.z, 0.02, 0.07) * ramp(1.75 - p.y, 0.02, 0.07));
  const double ear = 1.0 - ramp(glm::length(p - Vec3(0.082, 1.632, -0.012)), 0.030, 0.060);
  edge_m = glm::mix(edge_m, 0.0090, ear);
  edge_m = glm::mix(edge_m, 0.0235, ramp(0.62 - p.y, 0.0, 0.12));
  edge_m = glm::mix(edge_m, 0.0148, ramp(0.14 - p.y, 0.0, 0.10));
  return edge_m;
}

}  // namespace

TriangleMesh make_body_mesh() {
  const BodySdf sdf;
  return remesh(march_tetrahedra(sdf, finest_cell_m), sdf, target_edge_m, rounds);
}

}  // namespace nook::mannequin
