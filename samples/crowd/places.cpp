#include "samples/crowd/places.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace crowd {
namespace {

constexpr float two_pi = 2 * std::numbers::pi_v<float>;
constexpr float group_spacing_m = 2.6f;
constexpr float clearance_m = 0.03f;
constexpr int group_size = 3;

int bearing_index(float bearing_rad) {
  const float turns = bearing_rad / two_pi;
  return int((turns - std::floor(turns)) * Outline::bearings) % Outline::bearings;
}

// Gives the same values on every platform, unlike the distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float unit() { return float(engine_() >> 8) * 0x1p-24f; }
  float between(float low, float high) { return low + (high - low) * unit(); }

 private:
  std::mt19937 engine_;
};

// Bearings increase from +z towards +x, like the yaw.
bool overlap(const std::vector<Outline>& outlines, const Placement& a, const Placement& b) {
  const float bearing = std::atan2(b.x_m - a.x_m, b.z_m - a.z_m);
  const float needed = outlines[a.clip].reach(bearing - a.yaw_rad) +
                       outlines[b.clip].reach(bearing + two_pi / 2 - b.yaw_rad) + clearance_m;
  return (a.x_m - b.x_m) * (a.x_m - b.x_m) + (a.z_m - b.z_m) * (a.z_m - b.z_m) < needed * needed;
}

bool fits(const std::vector<Outline>& outlines, const std::vector<Placement>& crowd,
          const Placement& candidate) {
  return std::none_of(crowd.begin(), crowd.end(),
                      [&](const Placement& other) { return overlap(outlines, other, candidate); });
}

// Tries bearings around the leader, from near to far. If the group has no room, the member is left out.
void place_beside(const std::vector<Outline>& outlines, std::vector<Placement>& crowd,
                  const Placement& leader, Placement member, Random& random) {
  const float first = random.unit() * two_pi;
  for (float distance_m = 0.45f; distance_m < 1.6f; distance_m += 0.04f)
    for (int k = 0; k < 12; ++k) {
      const float bearing_rad = first + float(k) * two_pi / 12;
      member.x_m = leader.x_m + distance_m * std::sin(bearing_rad);
      member.z_m = leader.z_m + distance_m * std::cos(bearing_rad);
      if (fits(outlines, crowd, member)) return crowd.push_back(member);
    }
}

}  // namespace

float Outline::reach(float bearing_rad) const {
  const int middle = bearing_index(bearing_rad);
  float widest = 0;
  for (int d = -2; d <= 2; ++d)
    widest = std::max(widest, reach_m[std::size_t((middle + d + bearings) % bearings)]);
  return widest;
}

std::vector<Outline> clip_outlines(const Hero& hero) {
  std::vector<Outline> outlines(hero.clips().size());
  std::vector<float> positions, normals;
  for (std::size_t c = 0; c < outlines.size(); ++c)
    for (int step = 0; step < 8; ++step) {
      hero.skin(hero.pose(c, float(step) / 8), positions, normals);
      for (std::size_t i = 0; i < positions.size(); i += 3) {
        float& reach =
            outlines[c].reach_m[std::size_t(bearing_index(std::atan2(positions[i], positions[i + 2])))];
        reach = std::max(reach, std::hypot(positions[i], positions[i + 2]));
      }
    }
  return outlines;
}

std::vector<Placement> make_layout(const std::vector<Outline>& outlines, std::uint32_t count,
                                   std::uint32_t seed) {
  Random random(seed);
  std::uint32_t made = 0;
  const auto next_member = [&] {
    Placement p;
    // Characters use the clips in turn, so that a small crowd shows all of them.
    p.clip = made++ % std::uint32_t(outlines.size());
    p.phase = random.unit();
    p.yaw_rad = random.unit() * two_pi;
    return p;
  };
  const int groups = int((count + group_size - 1) / group_size);
  const int columns = std::max(1, int(std::ceil(std::sqrt(float(groups)))));
  float widest = 0;
  for (const Outline& o : outlines)
    widest = std::max(widest, *std::max_element(o.reach_m.begin(), o.reach_m.end()));
  const float spacing = std::max(group_spacing_m, 2.4f * widest);
  std::vector<Placement> crowd;
  // Members that do not fit into their group go to further rows of the grid.
  for (int cell = 0; crowd.size() < count; ++cell) {
    Placement leader = next_member();
    leader.x_m = (float(cell % columns) - float(columns - 1) / 2 + random.between(-0.2f, 0.2f)) * spacing;
    leader.z_m = (float(cell / columns) - float(columns - 1) / 2 + random.between(-0.2f, 0.2f)) * spacing;
    if (!fits(outlines, crowd, leader)) continue;
    crowd.push_back(leader);
    for (int m = 1; m < group_size && crowd.size() < count; ++m)
      place_beside(outlines, crowd, leader, next_member(), random);
  }
  return crowd;
}

float crowd_radius_m(const std::vector<Placement>& places) {
  float radius = 0;
  for (const Placement& p : places) radius = std::max(radius, std::hypot(p.x_m, p.z_m));
  return radius + 1.0f;
}

Bones placed_pose(const Hero& hero, const Placement& placement, float time_s) {
  const float duration_s = hero.clips()[placement.clip].duration_s;
  const float loops = placement.phase + (duration_s > 0 ? time_s / duration_s : 0);
  Bones bones = hero.pose(placement.clip, loops - std::floor(loops));
  const float c = std::cos(placement.yaw_rad), s = std::sin(placement.yaw_rad);
  for (std::size_t b = 0; b < bones.size(); b += 12)
    for (std::size_t column = 0; column < 4; ++column) {
      float& x = bones[b + column];
      float& z = bones[b + 8 + column];
      const float rotated = c * x + s * z;
      z = -s * x + c * z;
      x = rotated;
    }
  for (std::size_t b = 0; b < bones.size(); b += 12) {
    bones[b + 3] += placement.x_m;
    bones[b + 11] += placement.z_m;
  }
  return bones;
}

std::vector<Bones> pose_crowd(const Hero& hero, const std::vector<Placement>& places, float time_s) {
  std::vector<Bones> poses(places.size());
  tbb::parallel_for(std::size_t(0), places.size(),
                    [&](std::size_t i) { poses[i] = placed_pose(hero, places[i], time_s); });
  return poses;
}

}  // namespace crowd
