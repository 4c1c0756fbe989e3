#include "sdk/src/material/reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/parabolic.h"
#include "sdk/src/material/view_cells.h"

namespace nook::material {
namespace {

float dot(const Four& a, const Four& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

// Returns the view modes 4 f to 4 f + 3 of a cluster and a light mode.
Four mode_at(const TensorTables& tables, std::uint32_t cluster, std::uint32_t a, std::uint32_t f,
             const Fetches& at) {
  const std::uint32_t whole = tables.whole_modes();
  if (a >= whole) {
    const std::uint32_t pair = (cluster * tables.packed_modes + a - whole) * tables.view_vec4_count + f;
    return mean_over(at, [&](const ImagePlace& place) {
      return trilinear(tables.block_size(), tables.block_form, tables.blocks.data(), 2 * pair, place);
    });
  }
  const std::uint32_t layer = (cluster * whole + a) * tables.view_vec4_count + f;
  return mean_over(at, [&](const ImagePlace& place) {
    return tables.bits == 16 ? trilinear(tables.image_size(), tables.spatial.data(), layer, place)
                             : trilinear(tables.image_size(), tables.spatial_8.data(), layer, place);
  });
}

Fetches fetches_of(const Sample& sample) {
  return one_fetch({sample.u, sample.v, sample.level});
}

Fetches fetches_of(const Pixel& pixel, std::uint32_t width, std::uint32_t height) {
  return fetches_along(pixel.sides, width, height, pixel.fetches);
}

std::uint32_t member(const TensorTables& tables, std::size_t cell, std::uint32_t k) {
  const std::size_t count = std::size_t(tables.side) * tables.side;
  const std::size_t bytes = tables.member_bytes();
  const std::uint8_t* const at = &tables.membership[((k / 4 * count + cell) * 4 + k % 4) * bytes];
  if (bytes == 1) return *at;
  std::uint16_t value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

CellBlend blend_of(const TensorTables& tables, Vec3 view) {
  const ParabolicPoint p = to_parabolic(view);
  const auto place = [&](float at) { return std::clamp(0.5f * at + 0.5f, 0.0f, 1.0f) * float(tables.side); };
  const std::uint32_t neighbours =
      tables.blended ? member(tables, cell_of(view, tables.side), tables.terms) : no_neighbours;
  return blend_at(place(p.x), place(p.y), tables.side, neighbours);
}

Four blended(const TensorTables& tables, std::size_t layer, const CellBlend& blend) {
  const std::size_t count = std::size_t(tables.side) * tables.side;
  Four sum{};
  for (int i = 0; i < (tables.blended ? 3 : 1); ++i) {
    const Four value = four(&tables.coefficients[(layer * count + blend.cell[i]) * 4]);
    for (int b = 0; b < 4; ++b) sum[b] += blend.weight[i] * value[b];
  }
  return sum;
}

// Replaces places on the plane by the points of the relief that the view sees through them.
Fetches on_relief(const MaterialTables& tables, Fetches at, Vec3 view) {
  for (std::uint32_t i = 0; i < at.count; ++i) {
    ImagePlace& place = at.place[i];
    const TexturePlace seen = relief_place(tables.relief, {place.u, place.v}, place.level, view);
    place.u = seen.u;
    place.v = seen.v;
  }
  return at;
}

// Decodes the mean light modes of several places for a view. Each light mode is a sum over terms and view
// modes.
void decode(const TensorTables& tables, const Fetches& at, Vec3 view, float* modes) {
  const CellBlend blend = blend_of(tables, view);
  std::fill_n(modes, tables.light_modes, 0.0f);
  for (std::uint32_t k = 0; k < tables.terms; ++k) {
    const std::uint32_t cluster = tables.clusters > 1 ? member(tables, blend.cell[0], k) : 0;
    for (std::uint32_t f = 0; f < tables.view_vec4_count; ++f) {
      const Four coefficients = blended(tables, std::size_t(k) * tables.view_vec4_count + f, blend);
      for (std::uint32_t a = 0; a < tables.light_modes; ++a)
        modes[a] += dot(coefficients, mode_at(tables, cluster, a, f, at));
    }
  }
}

// The four texels of the light map around a direction.
struct LightPlace {
  Between x, y;
};
LightPlace light_place(std::uint32_t side, Vec3 light) {
  const ParabolicPoint p = to_parabolic(light);
  return {edge_clamped(0.5f * p.x + 0.5f, side), edge_clamped(0.5f * p.y + 0.5f, side)};
}

Four light_texel(const MaterialTables& tables, std::uint32_t layer, const Between& x, const Between& y) {
  const std::size_t side = tables.light_side;
  const auto texel = [&](std::uint32_t column, std::uint32_t row) {
    const std::size_t at = ((layer * side + row) * side + column) * 4;
    return tables.light_8.empty() ? four(&tables.light[at]) : four(&tables.light_8[at]);
  };
  return mix(mix(texel(x.low, y.low), texel(x.high, y.low), x.t),
             mix(texel(x.low, y.high), texel(x.high, y.high), x.t), y.t);
}

Radiance evaluate_neural(const NeuralTables& tables, const Fetches& at, Vec3 view, Vec3 light) {
  std::array<float, max_neural_units + 4> numbers;
  const auto decoded = std::span(numbers).first(tables.decoded_count());
  decode_neural_places(tables, at, view, decoded);
  const Vec3 radiance = neural_radiance(tables, decoded, light);
  return {radiance.x, radiance.y, radiance.z};
}

Radiance radiance_of(const MaterialTables& tables, const Fetches& at, Vec3 view, Vec3 light) {
  if (!(light.z > 0)) return {};
  if (tables.neural.is_used()) return evaluate_neural(tables.neural, at, view, light);
  std::array<float, 3 * max_directions + 3> modes;
  decode(tables.btf, on_relief(tables, at, view), view, modes.data());
  const LightPlace place = light_place(tables.light_side, light);
  float radiance[3] = {};
  const std::uint32_t light_vec4_count = tables.btf.light_modes / 4;
  for (std::uint32_t channel = 0; channel < 3; ++channel)
    for (std::uint32_t f = 0; f < light_vec4_count; ++f)
      radiance[channel] += dot(light_texel(tables, channel * light_vec4_count + f, place.x, place.y),
                               {modes[4 * f], modes[4 * f + 1], modes[4 * f + 2], modes[4 * f + 3]});
  return {radiance[0], radiance[1], radiance[2]};
}

float votf_of(const MaterialTables& tables, const Fetches& at, Vec3 view) {
  float value = 0;
  decode(tables.votf, at, view, &value);
  return value;
}

}  // namespace

Radiance evaluate_btf(const MaterialTables& tables, const Sample& sample) {
  return radiance_of(tables, fetches_of(sample), sample.view, sample.light);
}

Radiance evaluate_btf_pixel(const MaterialTables& tables, const Pixel& pixel) {
  return radiance_of(tables, fetches_of(pixel, tables.btf.width, tables.btf.height), pixel.view, pixel.light);
}

void decode_modes(const MaterialTables& tables, const Sample& sample, std::span<float> modes) {
  decode(tables.btf, on_relief(tables, fetches_of(sample), sample.view), sample.view, modes.data());
}

void decode_pixel_modes(const MaterialTables& tables, const Pixel& pixel, std::span<float> modes) {
  const Fetches at = fetches_of(pixel, tables.btf.width, tables.btf.height);
  decode(tables.btf, on_relief(tables, at, pixel.view), pixel.view, modes.data());
}

void light_basis_at(const MaterialTables& tables, Vec3 light, std::span<float> basis) {
  if (!(light.z > 0)) {
    std::fill(basis.begin(), basis.end(), 0.0f);
    return;
  }
  const LightPlace place = light_place(tables.light_side, light);
  for (std::uint32_t layer = 0; layer < 3 * tables.btf.light_modes / 4; ++layer) {
    const Four value = light_texel(tables, layer, place.x, place.y);
    std::copy(value.begin(), value.end(), &basis[4 * std::size_t(layer)]);
  }
}

float evaluate_votf(const MaterialTables& tables, const Sample& sample) {
  if (tables.visibility == VisibilityForm::none) return 1;
  return votf_of(tables, fetches_of(sample), sample.view);
}

float evaluate_votf_pixel(const MaterialTables& tables, const Pixel& pixel) {
  if (tables.visibility == VisibilityForm::none) return 1;
  return votf_of(tables, fetches_of(pixel, tables.votf.width, tables.votf.height), pixel.view);
}

float visibility_of(VisibilityForm form, const VisibilityMapping& mapping, float value) {
  if (form == VisibilityForm::none || value >= mapping.threshold) return 1;
  return value > 0 ? std::min(mapping.weight * value, 1.0f) : 0;
}

namespace {

// Calls body(direction) for stratified points of the unit disc, projected up to the hemisphere. The
// directions have a cosine-weighted distribution (Malley's method), so an unweighted mean over them is a
// cosine-weighted mean.
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
  // The light basis includes the cosine, and the directions are distributed in proportion to the cosine. So
  // the integral of the basis is pi times the mean of basis / cosine.
  Numbers lit{};
  const std::uint32_t lights = over_disc(64, [&](Vec3 light) {
    light_basis_at(tables, light, std::span(values).first(3 * modes));
    for (std::uint32_t i = 0; i < 3 * modes; ++i) lit[i] += double(values[i] / light.z);
  });
  Numbers seen{};
  // The level is clamped to the last level, which has one texel along the shorter side and a few along the
  // longer side.
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
  // The radiosity is pi times the mean radiance over cosine-weighted views. The irradiance is also pi, so the
  // quotient is the mean radiance.
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
