#include "bakers/lab/probe/texel_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/lab/probe/probe_methods.h"
#include "bakers/probe/map_bake.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::lab {
namespace {

using Json = nlohmann::ordered_json;
using namespace bake::probe;

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t sample_count = 20000;

// Rotates from Probulator's axes to the axes of Environment. Probulator's maps have -z in the middle and +x
// to the right of it.
Vec3 from_probulator(Vec3 v) {
  return {-v.z, v.y, v.x};
}

// Returns the digits of `i` in reverse order, after the radix point.
double radical_inverse(std::uint32_t i, std::uint32_t base) {
  double sum = 0;
  for (double digit = 1.0 / base; i > 0; i /= base, digit /= base) sum += digit * (i % base);
  return sum;
}

// Returns the texel whose normal is nearest to the direction.
std::size_t texel_at(const bake::Environment& map, Vec3 d) {
  const double u = std::atan2(double(d.z), double(d.x)) / (2 * pi) + 0.5,
               v = std::acos(std::clamp(double(d.y), -1.0, 1.0)) / pi;
  const auto column = std::size_t(u * (map.width() - 1.0)), row = std::size_t(v * (map.height() - 1.0));
  return row * map.width() + column;
}

Samples halton_samples(const bake::Environment& map) {
  Samples samples;
  for (std::uint32_t i = 0; i < sample_count; ++i) {
    const double z = 1 - 2 * radical_inverse(i, 2), angle = 2 * pi * radical_inverse(i, 3),
                 radius = std::sqrt(std::max(1 - z * z, 0.0));
    const Vec3 d =
        from_probulator({float(radius * std::cos(angle)), float(radius * std::sin(angle)), float(z)});
    samples.add(d, map.texel(texel_at(map, d)), 1);
  }
  return samples;
}

std::vector<Vec3> texel_normals(const bake::Environment& map) {
  std::vector<Vec3> normals;
  for (std::uint32_t row = 0; row < map.height(); ++row)
    for (std::uint32_t column = 0; column < map.width(); ++column) {
      const double around = pi * (2 * (column + 0.5) / (map.width() - 1.0) - 1),
                   down = pi * (row + 0.5) / (map.height() - 1.0);
      normals.push_back({float(std::sin(down) * std::cos(around)), float(std::cos(down)),
                         float(std::sin(down) * std::sin(around))});
    }
  return normals;
}

// As in Probulator, the light of each texel comes from the direction of the texel's normal.
std::vector<Vec3> irradiance_of(const bake::Environment& map, const std::vector<Vec3>& normals) {
  std::vector<Vec3> light(normals.size()), found(normals.size());
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = map.texel(i) * float(map.solid_angle(std::uint32_t(i / map.width())));
  tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t n) {
    double sum[3]{};
    for (std::size_t i = 0; i < light.size(); ++i) {
      const float cosine = dot(normals[n], normals[i]);
      if (cosine <= 0) continue;
      sum[0] += double(cosine * light[i].x);
      sum[1] += double(cosine * light[i].y);
      sum[2] += double(cosine * light[i].z);
    }
    found[n] = {float(sum[0]), float(sum[1]), float(sum[2])};
  });
  return found;
}

double mean_square(Vec3 v) {
  return double(dot(v, v)) / 3;
}

}  // namespace

Json texel_rows(const bake::Environment& map, const std::string& map_name, std::uint32_t lobes) {
  const Samples samples = halton_samples(map);
  const std::vector<Vec3> normals = texel_normals(map), truth = irradiance_of(map, normals);
  const float inverse_pi = float(1 / pi);
  Json rows = Json::array();
  for (ProbeMethod method : probe_methods(lobes, {})) {
    if (method.seeded || method.fit.growing_samples > 0) continue;  // not in Probulator
    for (Vec3& axis : method.basis.axis) axis = from_probulator(axis);
    nook::probe::Fit fit(method.basis, method.fit);
    add_samples(fit, samples, 0, samples.size());
    std::vector<Vec3> b(method.basis.count);
    fit.read(b);
    double irradiance = 0, by_area = 0, radiance = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vec3 e =
          nook::probe::irradiance(method.basis, b, nook::probe::IrradianceForm::fitted, normals[i]);
      const double off = mean_square((e - truth[i]) * inverse_pi);
      irradiance += off / double(normals.size());
      by_area += off * map.solid_angle(std::uint32_t(i / map.width())) / (4 * pi);
      radiance += mean_square(nook::probe::radiance(method.basis, b, normals[i]) - map.texel(i)) /
                  double(normals.size());
    }
    rows.push_back({{"map", map_name},
                    {"method", method.name},
                    {"irradiance_rms", std::sqrt(irradiance)},
                    {"irradiance_rms_area", std::sqrt(by_area)},
                    {"radiance_rms", std::sqrt(radiance)}});
  }
  return rows;
}

}  // namespace nook::lab
