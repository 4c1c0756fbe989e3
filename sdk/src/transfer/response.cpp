#include "sdk/src/transfer/response.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/spherical_gaussian.h"

namespace nook::transfer {
namespace {

// The finer grid has this many steps between two nodes.
constexpr std::uint32_t parts = 4;
// The minimum number of nodes along a side. Narrower lobes need more nodes. This minimum is needed to resolve
// light bases.
constexpr std::uint32_t min_side = 28;
std::uint32_t side_of(std::uint32_t lobes) {
  return std::clamp(std::uint32_t(std::lround(1.35 * std::sqrt(double(lobes)))), min_side, max_side);
}
std::uint32_t fine_side_of(std::uint32_t side) {
  return (side - 1) * parts + 1;
}
// A lobe is ignored where it is below exp(-reach) times its maximum.
constexpr float reach = 12;
// A lobe whose axis is below the horizon is ignored if all its values above the horizon are below this
// fraction of its maximum.
constexpr double lowest_share = 1e-4;

// Inverts the equal-area map. Points outside the disc of radius sqrt(2) return the downward direction.
Vec3 direction_at(float x, float y) {
  const float square = x * x + y * y;
  if (square >= 2) return {0, 0, -1};
  const float across = std::sqrt(2 - square);
  return {x * across, y * across, 1 - square};
}

double lowest_axis(double sharpness) {
  const double cosine = 1 + std::log(lowest_share) / sharpness;
  return cosine <= 0 ? -0.999 : -std::sqrt(1 - cosine * cosine);
}

// `values` has fine_side x fine_side rows with `count` values each.
void sum_response(float sharpness, const HemisphereCells& cells, const LightModes& modes, float radius,
                  std::uint32_t fine_side, Vector<float>& values) {
  const std::size_t count = std::size_t(3) * modes.light_modes;
  const float least_cosine = 1 - reach / sharpness;
  for (std::uint32_t row = 0; row < fine_side; ++row)
    for (std::uint32_t column = 0; column < fine_side; ++column) {
      const float x = radius * (2 * float(column) / float(fine_side - 1) - 1);
      const float y = radius * (2 * float(row) / float(fine_side - 1) - 1);
      const Vec3 axis = direction_at(x, y);
      float* const out = &values[(std::size_t(row) * fine_side + column) * count];
      for (std::size_t i = 0; i < cells.direction.size(); ++i) {
        if (dot(axis, cells.direction[i]) < least_cosine) continue;
        const float weight = cells.solid_angle * gaussian_value(axis, sharpness, cells.direction[i]);
        const float* const in = &modes.values[i * count];
        for (std::size_t k = 0; k < count; ++k) out[k] += weight * in[k];
      }
    }
}

// Solves the normal equations of linear interpolation along one axis, for all `count` values of a row at
// once. The matrix is tridiagonal and is solved by elimination. Its entries are sums over the fine steps
// between two nodes.
void to_nodes(std::uint32_t side, const float* fine, std::size_t fine_step, std::size_t count, float* nodes,
              std::size_t node_step) {
  float beside = 0, square = 0;
  for (std::uint32_t k = 1; k < parts; ++k) {
    const float t = float(k) / parts;
    beside += t * (1 - t);
    square += t * t;
  }
  float pivot[max_side];
  for (std::uint32_t i = 0; i < side; ++i) {
    pivot[i] = 1 + (i == 0 || i == side - 1 ? square : 2 * square);
    float* const out = nodes + i * node_step;
    std::fill_n(out, count, 0.0f);
    const int first = i == 0 ? 0 : -int(parts) + 1, last = i == side - 1 ? 0 : int(parts) - 1;
    for (int k = first; k <= last; ++k) {
      const float weight = 1 - std::abs(float(k)) / parts;
      const float* const in = fine + std::size_t(int(i * parts) + k) * fine_step;
      for (std::size_t c = 0; c < count; ++c) out[c] += weight * in[c];
    }
    if (i == 0) continue;
    const float factor = beside / pivot[i - 1];
    pivot[i] -= factor * beside;
    for (std::size_t c = 0; c < count; ++c) out[c] -= factor * nodes[(i - 1) * node_step + c];
  }
  for (std::uint32_t i = side; i-- > 0;) {
    float* const out = nodes + i * node_step;
    for (std::size_t c = 0; c < count; ++c)
      out[c] = (out[c] - (i + 1 < side ? beside * out[node_step + c] : 0)) / pivot[i];
  }
}

// Finds the nodes that a look-up inside the map's disc can interpolate between.
void find_rows(float radius, Response& response) {
  const std::uint32_t side = response.side;
  const float step = 2 * radius / float(side - 1), limit = radius + 1.5f * step;
  for (std::uint32_t row = 0; row < side; ++row) {
    const float y = step * float(row) - radius;
    const float half = std::sqrt(std::max(limit * limit - y * y, 0.0f));
    const auto at = [&](float x) { return std::clamp((x + radius) / step, 0.0f, float(side - 1)); };
    response.row_begin.push_back(std::uint16_t(std::floor(at(-half))));
    response.row_end.push_back(std::uint16_t(std::ceil(at(half)) + 1));
  }
}

}  // namespace

HemisphereCells::HemisphereCells(float sharpness, Memory* memory) : direction(memory) {
  // The width of a cell is a third of a lobe's width, but at most 3 degrees, because this resolution is
  // needed for light bases.
  const auto across = std::uint32_t(std::clamp(std::ceil(4 * std::sqrt(double(sharpness))), 48.0, 256.0));
  for (std::uint32_t row = 0; row < across; ++row)
    for (std::uint32_t column = 0; column < across; ++column) {
      const float x = 2 * (float(column) + 0.5f) / float(across) - 1;
      const float y = 2 * (float(row) + 0.5f) / float(across) - 1;
      if (x * x + y * y < 1) direction.push_back(direction_at(x, y));
    }
  // The solid angle of a region is twice its area on the map.
  solid_angle = 2 * (2 / float(across)) * (2 / float(across));
}

Response make_response(std::uint32_t lobes, const HemisphereCells& cells, const LightModes& modes,
                       Memory* memory) {
  const float sharpness = sharpness_of(lobes);
  Response response(memory);
  response.lobes = lobes;
  response.light_modes = modes.light_modes;
  response.lanes = std::uint32_t(padded_count(modes.light_modes));
  const std::uint32_t side = side_of(lobes), fine_side = fine_side_of(side);
  response.side = side;
  response.lowest_z = float(lowest_axis(double(sharpness)));
  const float radius = std::sqrt(1 - response.lowest_z);
  response.centre = 0.5f * float(side - 1);
  response.scale = response.centre / radius;
  find_rows(radius, response);

  const std::size_t count = std::size_t(3) * modes.light_modes;
  Vector<float> fine(std::size_t(fine_side) * fine_side * count, 0.0f, memory);
  sum_response(sharpness, cells, modes, radius, fine_side, fine);
  Vector<float> rows(std::size_t(fine_side) * side * count, 0.0f, memory),
      nodes(std::size_t(side) * side * count, 0.0f, memory);
  for (std::uint32_t row = 0; row < fine_side; ++row)
    to_nodes(side, &fine[std::size_t(row) * fine_side * count], count, count,
             &rows[std::size_t(row) * side * count], count);
  for (std::uint32_t column = 0; column < side; ++column)
    to_nodes(side, &rows[column * count], std::size_t(side) * count, count, &nodes[column * count],
             std::size_t(side) * count);
  response.table = AlignedArray<float>(std::size_t(side) * side * 3 * response.lanes, memory);
  for (std::size_t i = 0; i < std::size_t(side) * side * 3; ++i)
    std::copy_n(&nodes[i * modes.light_modes], modes.light_modes, &response.table[i * response.lanes]);

  response.even.assign(count, 0.0f);
  for (std::size_t i = 0; i < cells.direction.size(); ++i)
    for (std::size_t k = 0; k < count; ++k)
      response.even[k] += cells.solid_angle * modes.values[i * count + k];
  response.reflectance = modes.reflectance;
  response.light_hash = modes.light_hash;
  response.votf_hash = modes.votf_hash;

  response.padded = std::uint32_t(padded_count(lobes));
  Vector<Vec3> axes(lobes, Vec3{}, memory);
  lobe_axes(axes);
  for (AlignedArray<float>* axis : {&response.axis_x, &response.axis_y, &response.axis_z})
    *axis = AlignedArray<float>(response.padded, memory);
  for (std::uint32_t j = 0; j < lobes; ++j) {
    response.axis_x[j] = axes[j].x;
    response.axis_y[j] = axes[j].y;
    response.axis_z[j] = axes[j].z;
  }
  return response;
}

}  // namespace nook::transfer
