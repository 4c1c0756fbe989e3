#include "bakers/world/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/random.h"
#include "bakers/raytrace/ray_scene.h"

namespace nook::bake {
namespace {

// A low-discrepancy sequence in the unit square (Roberts 2018). It starts at a random place and adds 1 / g to
// x and 1 / g^2 to y each time, where g = 1.3247... solves g^3 = g + 1.
class UnitSquare {
 public:
  explicit UnitSquare(Random& random) : x_(random.unit_double()), y_(random.unit_double()) {}
  struct Place {
    double x, y;
  };
  Place next() {
    x_ = std::fmod(x_ + 0.7548776662466927, 1.0);
    y_ = std::fmod(y_ + 0.5698402909980532, 1.0);
    return {x_, y_};
  }

 private:
  double x_, y_;
};

float snapped(double metres) {
  return float((std::floor(metres / double(grid_step_m)) + 0.5) * double(grid_step_m));
}

Vec3 foot_of(std::span<const Vec3> body) {
  const Bounds b = bounds_of(body);
  return {0.5f * (b.low.x + b.high.x), b.low.y, 0.5f * (b.low.z + b.high.z)};
}

// Calls a function with points on a triangle. Neighbouring points are at most a grid step apart.
template <class Call>
void spread_over(Vec3 a, Vec3 b, Vec3 c, const Call& call) {
  const float longest = std::max({length(b - a), length(c - a), length(c - b)});
  const int steps = std::clamp(int(std::ceil(longest / grid_step_m)), 1, 200);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j)
      call(a + (float(i) / float(steps)) * (b - a) + (float(j) / float(steps)) * (c - a));
}

// The share of the floor's points in a square in its middle, and half the side length of this square.
constexpr double near_share = 0.75;
constexpr float near_half_m = 1.2f;

Vec3 bearing(float radians) {
  return {std::sin(radians), 0, std::cos(radians)};
}

}  // namespace

float floor_height(std::span<const Vec3> body) {
  return bounds_of(body).low.y;
}

SurfacePoints floor_points(std::span<const Vec3> body, std::size_t count, std::uint64_t seed) {
  const Vec3 foot = foot_of(body);
  Random random(seed);
  UnitSquare square(random);
  SurfacePoints points;
  const float half = 0.5f * floor_size_m;
  const auto near = std::size_t(near_share * double(count));
  const float near_area = 4 * near_half_m * near_half_m, area = floor_size_m * floor_size_m;
  const auto offer = [&](float reach, auto&& wanted, std::size_t need, float all) {
    while (need > 0) {
      const UnitSquare::Place at = square.next();
      const float x = snapped((2 * at.x - 1) * double(reach)), z = snapped((2 * at.y - 1) * double(reach));
      if (!wanted(x, z)) continue;
      points.add({foot.x + x, foot.y, foot.z + z}, {0, 1, 0}, all);
      --need;
    }
  };
  const auto is_near = [](float x, float z) { return std::max(std::abs(x), std::abs(z)) < near_half_m; };
  if (near > 0)
    offer(
        near_half_m, [](float, float) { return true; }, near, near_area / float(near));
  if (count > near)
    offer(
        half, [&](float x, float z) { return !is_near(x, z); }, count - near,
        (area - near_area) / float(count - near));
  return points;
}

SurfacePoints contact_points(const PosedBody& body, std::size_t count, std::uint64_t seed) {
  const Vec3 foot = foot_of(body.position);
  const auto cells = int(std::lround(floor_size_m / grid_step_m));
  std::vector<char> in_ring(std::size_t(cells) * std::size_t(cells), 0);
  const float half = 0.5f * floor_size_m;
  const auto mark = [&](Vec3 p) {
    const float height = p.y - foot.y;
    if (height >= contact_m) return;
    const float reach2 = contact_m * contact_m - height * height, reach = std::sqrt(reach2);
    const float x = p.x - foot.x + half, z = p.z - foot.z + half;
    const int first_row = std::max(0, int((z - reach) / grid_step_m)),
              last_row = std::min(cells - 1, int((z + reach) / grid_step_m));
    const int first = std::max(0, int((x - reach) / grid_step_m)),
              last = std::min(cells - 1, int((x + reach) / grid_step_m));
    for (int r = first_row; r <= last_row; ++r)
      for (int c = first; c <= last; ++c) {
        const float dx = (float(c) + 0.5f) * grid_step_m - x, dz = (float(r) + 0.5f) * grid_step_m - z;
        if (dx * dx + dz * dz <= reach2) in_ring[std::size_t(r) * std::size_t(cells) + std::size_t(c)] = 1;
      }
  };
  for (const Triangle& t : body.triangle) {
    const Vec3 a = body.position[t[0]], b = body.position[t[1]], c = body.position[t[2]];
    if (std::min({a.y, b.y, c.y}) - foot.y < contact_m) spread_over(a, b, c, mark);
  }
  std::vector<std::size_t> ring;
  for (std::size_t i = 0; i < in_ring.size(); ++i)
    if (in_ring[i]) ring.push_back(i);
  Random random(seed);
  const std::size_t used = std::min(count, ring.size());
  SurfacePoints points;
  for (std::size_t i = 0; i < used; ++i) {
    const double at = (double(i) + random.unit_double()) * double(ring.size()) / double(used);
    const std::size_t cell = ring[std::min(std::size_t(at), ring.size() - 1)];
    const float x = (float(cell % std::size_t(cells)) + 0.5f) * grid_step_m - half;
    const float z = (float(cell / std::size_t(cells)) + 0.5f) * grid_step_m - half;
    points.add({foot.x + x, foot.y, foot.z + z}, {0, 1, 0}, 1);
  }
  return points;
}

SurfacePoints wall_points(std::span<const Vec3> body, float bearing_radians, std::size_t count,
                          std::uint64_t seed) {
  const Vec3 foot = foot_of(body), away = bearing(bearing_radians), along{away.z, 0, -away.x};
  float nearest = -INFINITY;
  for (const Vec3 p : body) nearest = std::max(nearest, dot(p - foot, away));
  Random random(seed);
  UnitSquare square(random);
  SurfacePoints points;
  for (std::size_t i = 0; i < count; ++i) {
    const UnitSquare::Place at = square.next();
    const Vec3 place = foot + (nearest + wall_distance_m) * away +
                       snapped((at.x - 0.5) * double(wall_width_m)) * along +
                       Vec3{0, snapped(at.y * double(wall_height_m)), 0};
    points.add(place, -away, 1);
  }
  return points;
}

SurfacePoints neighbour_points(std::span<const Vec3> body, const PosedBody& other, float bearing_radians,
                               std::size_t count, std::uint64_t seed) {
  const Vec3 away = bearing(bearing_radians), foot = foot_of(body), other_foot = foot_of(other.position);
  float own = -INFINITY, theirs = -INFINITY;
  for (const Vec3 p : body) own = std::max(own, dot(p - foot, away));
  for (const Vec3 p : other.position) theirs = std::max(theirs, -dot(p - other_foot, away));
  const Vec3 move = foot - other_foot + (own + theirs + neighbour_gap_m) * away;
  std::vector<Vec3> normal;
  vertex_normals(other.triangle, other.position, normal);
  std::vector<double> up_to;
  double area = 0;
  for (const Triangle& t : other.triangle) {
    const Vec3 a = other.position[t[0]];
    area += double(length(cross(other.position[t[1]] - a, other.position[t[2]] - a)));
    up_to.push_back(area);
  }
  SurfacePoints points;
  if (!(area > 0)) return points;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (double(i) + random.unit_double()) / double(count) * area;
    const auto found = std::upper_bound(up_to.begin(), up_to.end(), at);
    const Triangle& t = other.triangle[std::min(std::size_t(found - up_to.begin()), up_to.size() - 1)];
    float u = random.unit(), v = random.unit();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const float w = 1 - u - v;
    const Vec3 n = normalised(w * normal[t[0]] + u * normal[t[1]] + v * normal[t[2]]);
    if (dot(n, n) == 0) continue;
    points.add(move + w * other.position[t[0]] + u * other.position[t[1]] + v * other.position[t[2]], n, 1);
  }
  return points;
}

}  // namespace nook::bake
