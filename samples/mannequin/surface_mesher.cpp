#include "samples/mannequin/surface_mesher.h"

#include <cmath>
#include <unordered_map>

namespace nook_samples::mannequin {
namespace {

struct Corner {
  int x, y, z;
};

Corner operator+(const Corner& a, const Corner& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

std::uint64_t key_of(const Corner& c) {
  constexpr int kOffset = 1 << 15;
  const auto pack = [](int v) { return static_cast<std::uint64_t>(v + kOffset); };
  return pack(c.x) << 32 | pack(c.y) << 16 | pack(c.z);
}

class Marcher {
 public:
  Marcher(const BodySdf& sdf, double cell_m) : sdf_(sdf), cell_m_(cell_m) {}

  TriangleMesh run() {
    // A cube of 2^9 cells round the figure, halved down to single cells where the skin may pass.
    visit({-256, -16, -256}, 512);
    return std::move(mesh_);
  }

 private:
  // The cube's diagonal is shared by six tetrahedra; neighbouring cubes agree on their common face's
  // diagonal.
  static constexpr Corner kSteps[6][3] = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}};

  Vec3 position_m(const Corner& c) const { return Vec3(c.x, c.y, c.z) * cell_m_; }

  double value_at(const Corner& c) {
    const auto [entry, is_new] = values_m_.try_emplace(key_of(c), 0.0);
    if (is_new) {
      // A corner exactly on the skin would make triangles without area.
      const double d = sdf_.distance(position_m(c));
      const double min_distance_m = 0.02 * cell_m_;
      entry->second = std::abs(d) < min_distance_m ? (d < 0.0 ? -min_distance_m : min_distance_m) : d;
    }
    return entry->second;
  }

  void visit(const Corner& low, int size) {
    if (size == 1) {
      for (const auto& steps : kSteps) {
        const Corner second = low + steps[0];
        const Corner third = second + steps[1];
        march({low, second, third, third + steps[2]});
      }
      return;
    }
    const int half = size / 2;
    const Vec3 centre_m = position_m(low + Corner{half, half, half});
    // The distance is an estimate, hence the margin over the half diagonal.
    constexpr double kMargin = 1.8;
    if (std::abs(sdf_.distance(centre_m)) > kMargin * std::sqrt(3.0) * half * cell_m_ && size < 64) {
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
    // The crossings are made one by one, because compilers differ in the order in which they evaluate
    // arguments.
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

}  // namespace

TriangleMesh march_tetrahedra(const BodySdf& sdf, double cell_m) {
  return Marcher(sdf, cell_m).run();
}

}  // namespace nook_samples::mannequin
