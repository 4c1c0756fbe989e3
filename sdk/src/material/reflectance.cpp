#include "sdk/src/material/reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/material/check.h"
#include "sdk/src/material/evaluate.h"

namespace nook::material {
namespace {

// Calls body(direction) for directions in strata of the unit disc, projected up: their plain mean is weighted
// by the cosine (Malley's method).
template <class Body>
std::uint32_t over_disc(std::uint32_t across, Body&& body) {
  std::uint32_t count = 0;
  for (std::uint32_t row = 0; row < across; ++row)
    for (std::uint32_t column = 0; column < across; ++column) {
      const float x = 2 * (float(column) + 0.5f) / float(across) - 1;
      const float y = 2 * (float(row) + 0.5f) / float(across) - 1;
      const float square = x * x + y * y;
      if (square >= 1) continue;
      body(Vec3{x, y, std::sqrt(1 - square)});
      ++count;
    }
  return count;
}

}  // namespace

Vec3 mean_reflectance(const MaterialTables& tables) {
  using Numbers = std::array<double, 3 * max_directions + 3>;
  const std::uint32_t modes = tables.btf.light_modes;
  std::array<float, 3 * max_directions + 3> values;
  // The light basis includes the cosine: its integral is pi times the mean of basis over cosine.
  Numbers lit{};
  const std::uint32_t lights = over_disc(64, [&](Vec3 light) {
    light_basis_at(tables, light, std::span(values).first(3 * modes));
    for (std::uint32_t i = 0; i < 3 * modes; ++i) lit[i] += double(values[i] / light.z);
  });
  Numbers seen{};
  // Levels beyond the last are clamped to it; it has one texel along the shorter side, and at most a few.
  const std::uint32_t across = 4;
  const std::uint32_t views = over_disc(16, [&](Vec3 view) {
    for (std::uint32_t i = 0; i < across * across; ++i) {
      Sample sample;
      sample.u = (float(i % across) + 0.5f) / float(across);
      sample.v = (float(i / across) + 0.5f) / float(across);
      sample.level = float(tables.btf.levels);
      sample.view = view;
      decode_modes(tables, sample, std::span(values).first(modes));
      for (std::uint32_t a = 0; a < modes; ++a) seen[a] += double(values[a]);
    }
  });
  // Radiosity is pi times the mean radiance over cosine-weighted views, for an irradiance of pi.
  float share[3];
  for (std::uint32_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (std::uint32_t a = 0; a < modes; ++a) sum += lit[c * modes + a] * seen[a];
    share[c] =
        float(std::clamp(3.14159265358979 * sum / (double(lights) * views * across * across), 0.0, 1.0));
  }
  return {share[0], share[1], share[2]};
}

}  // namespace nook::material
