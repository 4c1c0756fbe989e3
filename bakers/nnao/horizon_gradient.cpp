#include "bakers/nnao/horizon_gradient.h"

#include "bakers/raytrace/clones.h"

namespace nook::bake::nnao {
namespace {

void set_vector(Lanes* to, int lane, Vec3 from) {
  to[0][lane] = from.x;
  to[1][lane] = from.y;
  to[2][lane] = from.z;
}

constexpr int units = HorizonNetwork::units, tap_inputs = HorizonNetwork::tap_inputs;
constexpr int direction_gates = HorizonBatch::direction_gates, join_gates = HorizonBatch::join_gates,
              pooled_inputs = 2 * units;

// The offset of each layer in the parameter array.
constexpr int tap_layer = 0;
constexpr int tap_count = (tap_inputs + 1) * units;
constexpr int direction_layer = tap_layer + tap_count;
constexpr int join_layer = direction_layer + GatedOrder<pooled_inputs, direction_gates, units>::count;
constexpr int out_layer = join_layer + GatedOrder<units, join_gates, units>::count;
constexpr int bent_layer = out_layer + units;
constexpr int bent_outputs = 2;
static_assert(bent_layer + LinearOrder<pooled_inputs, direction_gates, bent_outputs>::count ==
              sizeof(HorizonNetwork) / sizeof(float));

typedef int LaneInts __attribute__((vector_size(4 * lane_count)));

}  // namespace

HorizonBatch::HorizonBatch(TapGrid tap_grid)
    : grid(tap_grid),
      tap(lane_array(std::size_t(grid.directions) * grid.steps * tap_inputs)),
      direction(lane_array(direction_gates * std::size_t(grid.directions))),
      tangent(lane_array(3 * std::size_t(grid.directions))) {}

HorizonTrace::HorizonTrace(TapGrid grid)
    : pooled(lane_array(std::size_t(grid.directions) * pooled_inputs)),
      direction_sums(lane_array(std::size_t(grid.directions) * units)),
      bent_sums(lane_array(std::size_t(grid.directions) * bent_outputs)),
      most_step(std::size_t(grid.directions) * units * lane_count) {}

void HorizonBatch::set(int lane, const View& view, const DataPoint& point, TapNoise noise) {
  using namespace nook::nnao;
  const float depth = view.depth[view.at(point.x, point.y)];
  const Vec3 position = view_position(view.rays, float(point.x) + 0.5f, float(point.y) + 0.5f, depth);
  const Vec3 viewer = to_viewer(view.rays, position);
  const PixelScale scale = pixel_scale(view.rays, depth);
  const float radius_px = point.radius * std::abs(scale.y);
  const float facing = dot(point.normal, viewer);
  set_vector(normal, lane, point.normal);
  set_vector(view_axis, lane, viewer);
  float horizons = 0;
  for (std::uint32_t d = 0; d < grid.directions; ++d) {
    const float angle = direction_angle(d, grid.directions, noise);
    const float cosine = std::cos(angle), sine = std::sin(angle);
    float horizon = 0;
    for (std::uint32_t s = 0; s < grid.steps; ++s) {
      const std::size_t t = std::size_t(d) * grid.steps + s;
      const float distance_px = step_distance_px(s, grid.steps, noise, radius_px);
      const TappedTexel texel =
          clamped_texel(view, point.x, point.y, horizon_tap(cosine, sine, distance_px, scale));
      const HorizonTapInput input =
          horizon_tap_input(view, texel, position, point.normal, viewer, point.radius);
      horizon = std::max(horizon, input[2]);
      for (int i = 0; i < tap_inputs; ++i) tap[t * tap_inputs + std::size_t(i)][lane] = input[std::size_t(i)];
    }
    Lanes* const gate = &direction[d * direction_gates];
    const Vec3 across = across_viewer(viewer, cosine, sine);
    gate[0][lane] = dot(point.normal, across);
    gate[1][lane] = facing;
    set_vector(&tangent[3 * d], lane, across);
    horizons += horizon;
  }
  bound[lane] = float(NOOK_HORIZON_BOUND) * horizons / float(grid.directions);
  join[0][lane] = facing;
  join[1][lane] = border_distance(view, point.x, point.y, radius_px);
}

static NOOK_INLINE void horizon_forward_plain(const float* parameters, const HorizonBatch& batch,
                                              HorizonTrace& trace, HorizonOutput& output) {
  const auto [directions, steps] = batch.grid;
  for (int u = 0; u < units; ++u) trace.joined[u] = Lanes{};
  for (int i = 0; i < 3; ++i) output.bent[i] = batch.normal[i];
  for (std::uint32_t d = 0; d < directions; ++d) {
    Lanes* const pooled = &trace.pooled[d * pooled_inputs];
    LaneInts most_step[units] = {};
    for (std::uint32_t s = 0; s < steps; ++s) {
      const std::size_t t = std::size_t(d) * steps + s;
      Lanes hidden[units];
      threshold_forward<tap_inputs, units>(parameters + tap_layer, &batch.tap[t * tap_inputs], hidden);
      for (int u = 0; u < units; ++u) {
        const Lanes h = hidden[u];
        const LaneInts here = LaneInts{} + int(s);
        if (s == 0) {
          pooled[u] = h;
          pooled[units + u] = h;
        } else {
          most_step[u] = h > pooled[u] ? here : most_step[u];
          pooled[u] = h > pooled[u] ? h : pooled[u];
          pooled[units + u] += h;
        }
      }
    }
    for (int u = 0; u < units; ++u) {
      pooled[units + u] *= 1 / float(steps);
      __builtin_memcpy(&trace.most_step[(d * units + std::size_t(u)) * lane_count], &most_step[u],
                       sizeof(LaneInts));
    }
    Lanes out[units];
    gated_forward<pooled_inputs, direction_gates, units>(parameters + direction_layer, pooled,
                                                         &batch.direction[d * direction_gates],
                                                         &trace.direction_sums[d * units], out);
    for (int u = 0; u < units; ++u) trace.joined[u] += out[u];
    Lanes bent[bent_outputs];
    linear_forward<pooled_inputs, direction_gates, bent_outputs>(parameters + bent_layer, pooled,
                                                                 &batch.direction[d * direction_gates],
                                                                 &trace.bent_sums[d * bent_outputs], bent);
    for (int i = 0; i < 3; ++i)
      output.bent[i] += (bent[0] * batch.tangent[3 * d + std::size_t(i)] + bent[1] * batch.view_axis[i]) *
                        (1 / float(directions));
  }
  for (int u = 0; u < units; ++u) trace.joined[u] *= 1 / float(directions);
  gated_forward<units, join_gates, units>(parameters + join_layer, trace.joined, batch.join, trace.join_sums,
                                          trace.join_output);
  trace.darkness = Lanes{};
  for (int u = 0; u < units; ++u) trace.darkness -= parameters[out_layer + u] * trace.join_output[u];
  output.ao = 1.0f - (trace.darkness < batch.bound ? trace.darkness : batch.bound);
}

NOOK_CLONED(void, horizon_forward,
            (const float* parameters, const HorizonBatch& batch, HorizonTrace& trace, HorizonOutput& output),
            (parameters, batch, trace, output))

static NOOK_INLINE void horizon_backward_plain(const float* parameters, const HorizonBatch& batch,
                                               const HorizonTrace& trace,
                                               const HorizonOutput& output_gradient, Lanes* gradient) {
  const auto [directions, steps] = batch.grid;
  const Lanes g_ao = trace.darkness < batch.bound ? output_gradient.ao : Lanes{};
  Lanes g_towards{};
  for (int i = 0; i < 3; ++i) g_towards += output_gradient.bent[i] * batch.view_axis[i];
  Lanes g_join[units], g_joined[units];
  for (int u = 0; u < units; ++u) {
    gradient[out_layer + u] += g_ao * trace.join_output[u];
    g_join[u] = parameters[out_layer + u] * g_ao;
  }
  gated_backward<units, join_gates, units>(parameters + join_layer, trace.joined, batch.join, trace.join_sums,
                                           g_join, gradient + join_layer, g_joined);
  // The gradient of the tap layer is summed here, because the loop over taps takes most of the time.
  Lanes g_tap_layer[tap_count] = {};
  for (std::uint32_t d = 0; d < directions; ++d) {
    Lanes g_pooled[pooled_inputs], g_out[units];
    for (int u = 0; u < units; ++u) g_out[u] = g_joined[u] * (1 / float(directions));
    gated_backward<pooled_inputs, direction_gates, units>(
        parameters + direction_layer, &trace.pooled[d * pooled_inputs], &batch.direction[d * direction_gates],
        &trace.direction_sums[d * units], g_out, gradient + direction_layer, g_pooled);
    Lanes g_bent[bent_outputs] = {Lanes{}, g_towards * (1 / float(directions))};
    for (int i = 0; i < 3; ++i)
      g_bent[0] += output_gradient.bent[i] * batch.tangent[3 * d + std::size_t(i)] * (1 / float(directions));
    linear_backward<pooled_inputs, direction_gates, bent_outputs>(
        parameters + bent_layer, &trace.pooled[d * pooled_inputs], &batch.direction[d * direction_gates],
        &trace.bent_sums[d * bent_outputs], g_bent, gradient + bent_layer, g_pooled);
    for (int u = 0; u < units; ++u) g_pooled[units + u] *= 1 / float(steps);
    LaneInts most_step[units];
    for (int u = 0; u < units; ++u)
      __builtin_memcpy(&most_step[u], &trace.most_step[(d * units + std::size_t(u)) * lane_count],
                       sizeof(LaneInts));
    for (std::uint32_t s = 0; s < steps; ++s) {
      const std::size_t t = std::size_t(d) * steps + s;
      Lanes hidden[units], g_hidden[units];
      threshold_forward<tap_inputs, units>(parameters + tap_layer, &batch.tap[t * tap_inputs], hidden);
      const LaneInts here = LaneInts{} + int(s);
      for (int u = 0; u < units; ++u)
        g_hidden[u] = most_step[u] == here ? g_pooled[u] + g_pooled[units + u] : g_pooled[units + u];
      threshold_backward<tap_inputs, units>(&batch.tap[t * tap_inputs], hidden, g_hidden, g_tap_layer);
    }
  }
  for (int i = 0; i < tap_count; ++i) gradient[tap_layer + i] += g_tap_layer[i];
}

NOOK_CLONED(void, horizon_backward,
            (const float* parameters, const HorizonBatch& batch, const HorizonTrace& trace,
             const HorizonOutput& output_gradient, Lanes* gradient),
            (parameters, batch, trace, output_gradient, gradient))

}  // namespace nook::bake::nnao
