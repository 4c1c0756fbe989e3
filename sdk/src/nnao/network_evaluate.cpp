#include "sdk/src/nnao/network_evaluate.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sdk/src/core/failure.h"

namespace nook::nnao {
namespace {

float prelu(float x, float negative_slope, float positive_slope) {
  return x > 0 ? positive_slope * x : negative_slope * x;
}

template <int inputs, int units>
std::array<float, units> sums(const std::array<float, std::size_t(inputs) * units>& weights,
                              std::array<float, units> out, const std::array<float, inputs>& input) {
  for (int i = 0; i < inputs; ++i)
    for (int u = 0; u < units; ++u) out[u] += weights[i * units + u] * input[i];
  return out;
}

template <int inputs, int units>
std::array<float, units> through(const Dense<inputs, units>& layer,
                                 std::type_identity_t<const std::array<float, inputs>&> input) {
  std::array<float, units> out = sums<inputs, units>(layer.weights, layer.bias, input);
  for (int u = 0; u < units; ++u) out[u] = prelu(out[u], layer.negative_slope[u], layer.positive_slope[u]);
  return out;
}

template <int inputs, int gates, int units>
std::array<float, units> through(const GatedDense<inputs, gates, units>& layer,
                                 std::type_identity_t<const std::array<float, inputs>&> input,
                                 std::type_identity_t<const std::array<float, gates>&> gate) {
  std::array<float, units> out = sums<inputs, units>(layer.weights, {}, input);
  std::array<float, units> factor;
  factor.fill(1);
  factor = sums<gates, units>(layer.gate_weights, factor, gate);
  for (int u = 0; u < units; ++u) {
    out[u] *= factor[u];
    out[u] = std::max(out[u], layer.slope[u] * out[u]);
  }
  return out;
}

template <int inputs, int gates, int units>
std::array<float, units> through(const GatedLinear<inputs, gates, units>& layer,
                                 std::type_identity_t<const std::array<float, inputs>&> input,
                                 std::type_identity_t<const std::array<float, gates>&> gate) {
  std::array<float, units> out = sums<inputs, units>(layer.weights, {}, input);
  std::array<float, units> factor;
  factor.fill(1);
  factor = sums<gates, units>(layer.gate_weights, factor, gate);
  for (int u = 0; u < units; ++u) out[u] *= factor[u];
  return out;
}

template <int inputs, int units>
std::array<float, units> through(const ThresholdDense<inputs, units>& layer,
                                 std::type_identity_t<const std::array<float, inputs>&> input) {
  std::array<float, units> out = sums<inputs, units>(layer.weights, {}, input);
  for (int u = 0; u < units; ++u) out[u] = std::max(out[u] - layer.threshold[u], 0.0f);
  return out;
}

// Values of the centre pixel that both forms of the network need.
struct Centre {
  Vec3 position, normal, viewer;
  PixelScale scale;
  PixelRadius radius;
};

Centre centre_of(const View& view, Vec3 normal, const Sampling& sampling, std::uint32_t x, std::uint32_t y) {
  Centre centre;
  const float depth = view.depth[view.at(x, y)];
  centre.position = view_position(view.rays, float(x) + 0.5f, float(y) + 0.5f, depth);
  centre.normal = normal;
  centre.viewer = to_viewer(view.rays, centre.position);
  centre.scale = pixel_scale(view.rays, depth);
  centre.radius = pixel_radius(sampling, centre.scale, depth);
  return centre;
}

Vec3 texel_position(const View& view, TappedTexel texel) {
  return view_position(view.rays, float(texel.x) + 0.5f, float(texel.y) + 0.5f,
                       texel.surface ? view.depth[view.at(texel.x, texel.y)] : sky_depth);
}

using PaperUnits = std::array<float, PaperNetwork::units>;

// Returns the units of the first layer of the paper's network.
PaperUnits paper_units(const PaperNetwork& network, const View& view, Vec3 normal, const Sampling& sampling,
                       std::uint32_t x, std::uint32_t y, TapNoise noise) {
  constexpr int units = PaperNetwork::units, inputs = PaperNetwork::tap_inputs;
  const Centre centre = centre_of(view, normal, sampling, x, y);
  PaperUnits sum{};
  for (std::uint32_t tap = 0; tap < sampling.taps; ++tap) {
    const std::uint32_t cell = paper_tap_cell(tap, sampling.taps, noise);
    const TapOffset offset = paper_tap(cell, sampling.taps, noise, centre.radius.metres, centre.scale);
    std::array<float, inputs> input;
    if (!paper_tap_input(view, tapped_texel(view, x, y, offset), centre.position, centre.normal,
                         centre.radius.metres, input))
      continue;
    const float* filter = &network.filters[std::size_t(cell) * inputs * units];
    for (int i = 0; i < inputs; ++i)
      for (int u = 0; u < units; ++u) sum[u] += filter[i * units + u] * input[i];
  }
  const float scale = float(PaperNetwork::grid_size * PaperNetwork::grid_size) / float(sampling.taps);
  for (int u = 0; u < units; ++u)
    sum[u] = prelu(network.bias[u] + scale * sum[u], network.negative_slope[u], network.positive_slope[u]);
  return sum;
}

// The input and gate of the layer `join`, and the outputs that do not depend on `join`.
struct JoinInput {
  std::array<float, HorizonNetwork::units> mean{};
  std::array<float, 2> gate{};
  float bound = 0;
  Vec3 bent;  // not normalised
};

JoinInput join_input(const HorizonNetwork& network, const View& view, Vec3 normal, const Sampling& sampling,
                     std::uint32_t x, std::uint32_t y, TapNoise noise) {
  constexpr int units = HorizonNetwork::units;
  const Centre centre = centre_of(view, normal, sampling, x, y);
  const TapGrid grid = horizon_grid(sampling.taps);
  const float facing = dot(centre.normal, centre.viewer);
  JoinInput joined{};
  joined.bent = centre.normal;
  for (std::uint32_t d = 0; d < grid.directions; ++d) {
    const float angle = direction_angle(d, grid.directions, noise);
    const float cosine = std::cos(angle), sine = std::sin(angle);
    std::array<float, 2 * units> pooled{};
    float* const most = pooled.data();
    float* const mean = pooled.data() + units;
    float horizon = 0;
    for (std::uint32_t s = 0; s < grid.steps; ++s) {
      const float distance_px = step_distance_px(s, grid.steps, noise, centre.radius.px);
      const TappedTexel texel =
          clamped_texel(view, x, y, horizon_tap(cosine, sine, distance_px, centre.scale));
      const HorizonTapInput input =
          horizon_tap_input(view, texel, centre.position, centre.normal, centre.viewer, centre.radius.metres);
      horizon = std::max(horizon, input[2]);
      const auto hidden = through(network.tap, input);
      for (int u = 0; u < units; ++u) {
        most[u] = s == 0 ? hidden[u] : std::max(most[u], hidden[u]);
        mean[u] += hidden[u] / float(grid.steps);
      }
    }
    const Vec3 tangent = across_viewer(centre.viewer, cosine, sine);
    const std::array<float, 2> gate{dot(centre.normal, tangent), facing};
    const float share = 1 / float(grid.directions);
    const auto out = through(network.direction, pooled, gate);
    for (int u = 0; u < units; ++u) joined.mean[u] += out[u] * share;
    joined.bound += float(NOOK_HORIZON_BOUND) * horizon * share;
    const auto [aside, towards] = through(network.bent, pooled, gate);
    joined.bent = joined.bent + aside * share * tangent + towards * share * centre.viewer;
  }
  joined.gate = {facing, border_distance(view, x, y, centre.radius.px)};
  return joined;
}

}  // namespace

ScreenRays screen_rays(const float (&projection)[16], std::uint32_t width, std::uint32_t height) {
  ScreenRays rays;
  // The matrix is column-major: clip.x = m[0] x + m[8] z + m[12] w; clip.w = -z or 1.
  rays.orthographic = projection[11] == 0;
  const float shift_x = rays.orthographic ? -projection[12] : projection[8];
  const float shift_y = rays.orthographic ? -projection[13] : projection[9];
  rays.x_scale = 2 / (float(width) * projection[0]);
  rays.y_scale = 2 / (float(height) * projection[5]);
  rays.x_offset = (shift_x - 1) / projection[0];
  rays.y_offset = (shift_y - 1) / projection[5];
  return rays;
}

TappedTexel tapped_texel(const View& view, std::uint32_t x, std::uint32_t y, TapOffset offset) {
  const float column = std::floor(float(x) + 0.5f + offset.x_px),
              row = std::floor(float(y) + 0.5f + offset.y_px);
  if (!(column >= 0 && column < float(view.width) && row >= 0 && row < float(view.height))) return {};
  TappedTexel texel{false, std::uint32_t(column), std::uint32_t(row)};
  texel.surface = view.has_surface(texel.x, texel.y);
  return texel;
}

TappedTexel clamped_texel(const View& view, std::uint32_t x, std::uint32_t y, TapOffset offset) {
  const auto clamped = [](float place, std::uint32_t size) {
    return std::uint32_t(std::clamp(std::floor(place), 0.0f, float(size - 1)));
  };
  TappedTexel texel{false, clamped(float(x) + 0.5f + offset.x_px, view.width),
                    clamped(float(y) + 0.5f + offset.y_px, view.height)};
  texel.surface = view.has_surface(texel.x, texel.y);
  return texel;
}

HorizonTapInput horizon_tap_input(const View& view, TappedTexel texel, Vec3 position, Vec3 normal,
                                  Vec3 viewer, float radius) {
  const Vec3 v = texel_position(view, texel) - position;
  // At the border of the screen, a tap can be clamped to the pixel itself. Its v is then only a rounding
  // error, so |v| is raised to half a pixel.
  const PixelScale scale = pixel_scale(view.rays, -position.z);
  const float away = std::max(length(v), 0.5f / std::max(std::abs(scale.x), std::abs(scale.y)));
  const float elevation = dot(v, normal) / away, angle = dot(v, viewer) / away;
  const float nearness = std::max(1 - 0.5f * away / radius, 0.0f);
  return {elevation, elevation * angle, elevation * nearness, elevation * angle * nearness};
}

bool paper_tap_input(const View& view, TappedTexel texel, Vec3 position, Vec3 normal, float radius,
                     std::array<float, PaperNetwork::tap_inputs>& input) {
  if (!texel.surface) return false;
  const Vec3 v = texel_position(view, texel) - position;
  const float weight = 1 - length(v) / radius;
  if (!(weight > 0)) return false;
  const Vec3 turn = view.normal[view.at(texel.x, texel.y)] - normal;
  input = {turn.x * weight, turn.y * weight, turn.z * weight, v.z / radius * weight};
  return true;
}

Openness evaluate_openness(const Network& network, const View& view, Vec3 normal, const Sampling& sampling,
                           std::uint32_t x, std::uint32_t y, TapNoise noise) {
  const float share = centre_of(view, normal, sampling, x, y).radius.share;
  const auto shared = [&](float ao) { return share * ao + (1 - share); };
  if (network.form == NetworkForm::paper) {
    const PaperNetwork& paper = network.paper;
    const PaperUnits units = paper_units(paper, view, normal, sampling, x, y, noise);
    return {shared(through(paper.layer_3, through(paper.layer_2, through(paper.layer_1, units)))[0]), normal};
  }
  const HorizonNetwork& horizon = network.horizon;
  const JoinInput joined = join_input(horizon, view, normal, sampling, x, y, noise);
  const auto units = through(horizon.join, joined.mean, joined.gate);
  float darkness = 0;
  for (std::size_t u = 0; u < units.size(); ++u) darkness -= horizon.out[u] * units[u];
  const Vec3 bent = joined.bent * share + normal * (1 - share);
  const float size = length(bent);
  return {shared(1 - std::min(darkness, joined.bound)), size > 1e-6f ? bent * (1 / size) : normal};
}

float evaluate_unclamped(const Network& network, const View& view, Vec3 normal, const Sampling& sampling,
                         std::uint32_t x, std::uint32_t y, TapNoise noise) {
  return evaluate_openness(network, view, normal, sampling, x, y, noise).ao;
}

std::array<float, 3> first_units(const Network& network, const View& view, const Sampling& sampling,
                                 std::uint32_t x, std::uint32_t y) {
  const Vec3 normal = view.normal[view.at(x, y)];
  const TapNoise noise = tap_noise(x, y);
  const auto first = [](const auto& units) { return std::array<float, 3>{units[0], units[1], units[2]}; };
  return network.form == NetworkForm::paper
             ? first(paper_units(network.paper, view, normal, sampling, x, y, noise))
             : first(join_input(network.horizon, view, normal, sampling, x, y, noise).mean);
}

float evaluate_pixel(const Network& network, const View& view, const Sampling& sampling, std::uint32_t x,
                     std::uint32_t y) {
  if (!view.has_surface(x, y)) return 1;
  return std::clamp(
      evaluate_unclamped(network, view, view.normal[view.at(x, y)], sampling, x, y, tap_noise(x, y)), 0.0f,
      1.0f);
}

void evaluate(const Network& network, const View& view, const Sampling& sampling, std::span<float> ao) {
  const std::size_t pixels = std::size_t(view.width) * view.height;
  if (view.depth.size() != pixels || view.normal.size() != pixels || ao.size() != pixels)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "depths, normals and AO must have one entry per pixel (got %zu, %zu and %zu, need %zu)",
                  view.depth.size(), view.normal.size(), ao.size(), pixels);
  if (!(sampling.radius > 0) || !std::isfinite(sampling.radius) || !(sampling.max_radius_px >= 1))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the radius is out of range (got %g m and at most %g px, need more than 0 m and at least 1 px)",
        double(sampling.radius), double(sampling.max_radius_px));
  constexpr std::uint32_t cells = PaperNetwork::grid_size * PaperNetwork::grid_size;
  if (network.form == NetworkForm::paper ? sampling.taps < 1 || sampling.taps > cells
                                         : horizon_grid(sampling.taps).steps == 0)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the number of taps does not fit the network (got %u, need 9, 16, 32, 64, 128 or 256, or 1 to %u "
        "for the paper's form)",
        sampling.taps, cells);
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x)
      ao[view.at(x, y)] = evaluate_pixel(network, view, sampling, x, y);
}

}  // namespace nook::nnao
