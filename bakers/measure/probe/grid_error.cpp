#include "bakers/measure/probe/grid_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "bakers/probe/inside_probes.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::bake::probe {
namespace {

using nook::probe::Grid;

struct Box {
  Vec3 low, high;
  bool holds(Vec3 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
};

// Returns the box of all cells. The cell of a probe extends half a grid spacing to each side.
Box box_of(const Grid& grid) {
  const Vec3 low = grid.origin_ws - 0.5f * grid.spacing_ws;
  const Vec3 size{grid.spacing_ws.x * float(grid.counts[0]), grid.spacing_ws.y * float(grid.counts[1]),
                  grid.spacing_ws.z * float(grid.counts[2])};
  return {low, low + size};
}

Vec3 nearest_probe(const Grid& grid, const std::vector<bool>& inside, Vec3 point) {
  float least = std::numeric_limits<float>::infinity();
  Vec3 nearest = grid.origin_ws;
  for (std::size_t p = 0; p < grid.size(); ++p) {
    const Vec3 d = grid.position_ws(p) - point;
    if (inside[p] || dot(d, d) >= least) continue;
    least = dot(d, d);
    nearest = grid.position_ws(p);
  }
  return nearest;
}

Vec3 uniform_direction(Random& random) {
  const float y = 1 - 2 * random.unit(), angle = 2 * std::numbers::pi_v<float> * random.unit();
  const float radius = std::sqrt(std::max(1 - y * y, 0.0f));
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

// The maximum number of attempts to draw a valid random place.
constexpr std::size_t most_draws = 1000;

[[noreturn]] void no_place(const char* where) {
  throw Failure(
      NOOK_ERROR_INVALID_ARGUMENT,
      "almost no place %s lies inside the box of the grid; give the scene that the grid was baked from",
      where);
}

}  // namespace

Places places_on_surfaces(const LitScene& scene, const TriangleSoup& soup, const Grid& grid,
                          const std::vector<bool>& inside, float origin_offset, std::size_t count,
                          std::uint64_t seed) {
  const FlushDenormals flush;
  const Box box = box_of(grid);
  std::vector<double> area;  // running sum
  double total = 0;
  for (const auto& t : soup.triangle) {
    const Vec3 a = soup.position[t[0]];
    total += double(length(cross(soup.position[t[1]] - a, soup.position[t[2]] - a)));
    area.push_back(total);
  }
  Places places;
  Random random(mix_bits(seed));
  for (std::size_t draw = 0; places.normal.size() < count; ++draw) {
    if (draw >= most_draws * count || !(total > 0)) no_place("on a surface");
    const auto at = std::upper_bound(area.begin(), area.end(), random.unit_double() * total);
    const auto& t = soup.triangle[std::min(std::size_t(at - area.begin()), area.size() - 1)];
    const Vec3 a = soup.position[t[0]], b = soup.position[t[1]], c = soup.position[t[2]];
    const float root = std::sqrt(random.unit()), share = random.unit();
    const Vec3 point = a * (1 - root) + b * (root * (1 - share)) + c * (root * share);
    const Vec3 normal = normalised(cross(b - a, c - a));
    if (!box.holds(point) || dot(normal, normal) == 0) continue;
    const bool front_inside = is_inside(scene, point + origin_offset * normal);
    const bool back_inside = is_inside(scene, point - origin_offset * normal);
    if (front_inside && back_inside) continue;
    const bool faces = dot(normal, nearest_probe(grid, inside, point) - point) >= 0;
    const bool front = front_inside == back_inside ? faces : back_inside;
    places.position_ws.push_back(point);
    places.normal.push_back(front ? normal : -normal);
  }
  return places;
}

Places places_in_the_open(const LitScene& scene, const Grid& grid, std::size_t count, std::uint64_t seed) {
  const FlushDenormals flush;
  const Box box = box_of(grid);
  const Vec3 size = box.high - box.low;
  Places places;
  Random random(mix_bits(seed + 1));
  for (std::size_t draw = 0; places.normal.size() < count; ++draw) {
    if (draw >= most_draws * count) no_place("outside solids");
    const float x = random.unit(), y = random.unit(), z = random.unit();
    const Vec3 point = box.low + Vec3{x * size.x, y * size.y, z * size.z};
    if (is_inside(scene, point)) continue;
    places.position_ws.push_back(point);
    places.normal.push_back(uniform_direction(random));
  }
  return places;
}

TracedPlaces trace_places(const LitScene& scene, const Places& places, std::uint32_t paths,
                          std::uint64_t seed, const PathSettings& path, const Progress& progress) {
  TracedPlaces traced;
  const std::size_t count = places.normal.size();
  const auto half = [&](std::size_t h) {
    const IrradianceSettings settings{std::max(paths / 2, 1u), mix_bits(seed) + h, path};
    return trace_irradiance(
        scene, {places.position_ws, places.normal}, settings,
        [&](std::size_t done, std::size_t) { return !progress || progress(h * count + done, 2 * count); });
  };
  traced.first = half(0);
  traced.second = half(1);
  return traced;
}

GridError error_of(const TracedPlaces& truth, const std::vector<Vec3>& found,
                   const std::vector<std::size_t>& which) {
  GridError error;
  double square = 0, noise = 0;
  for (const std::size_t i : which) {
    const Vec3 traced = truth.mean(i), apart = 0.5f * (truth.first[i] - truth.second[i]);
    const Vec3 off = found[i] - traced;
    error.mean += double(traced.x + traced.y + traced.z);
    error.bias += double(off.x + off.y + off.z);
    square += double(dot(off, off));
    noise += double(dot(apart, apart));
    error.worst =
        std::max({error.worst, double(std::abs(off.x)), double(std::abs(off.y)), double(std::abs(off.z))});
  }
  const double numbers = 3 * double(which.size());
  error.mean /= numbers;
  error.bias /= numbers;
  error.noise = std::sqrt(noise / numbers);
  error.rms = std::sqrt(std::max(square - noise, 0.0) / numbers);
  return error;
}

GridError grid_error(const LitScene& scene, const nook::probe::Probes& probes, const Places& places,
                     std::uint32_t paths, std::uint64_t seed, const PathSettings& path,
                     const Progress& progress) {
  const TracedPlaces truth = trace_places(scene, places, paths, seed, path, progress);
  const std::size_t count = places.normal.size();
  std::vector<Vec3> found(count), coefficients(probes.basis.count);
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 normal = places.normal[i];
    const Vec3 step = by_channel(normal, probes.grid.spacing_ws) * places.lookup_offset;
    nook::probe::interpolate(probes, places.position_ws[i] + step, normal, coefficients);
    found[i] =
        nook::probe::irradiance(probes.basis, coefficients, nook::probe::IrradianceForm::bands, normal);
    all[i] = i;
  }
  return error_of(truth, found, all);
}

}  // namespace nook::bake::probe
