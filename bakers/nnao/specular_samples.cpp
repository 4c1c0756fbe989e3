#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "bakers/nnao/cameras.h"
#include "bakers/nnao/specular_fit.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/specular_visibility.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/filter.h"

namespace nook::bake::nnao {

using nook::nnao::LitPixel;

namespace {

// A pixel of a view in world space.
struct Surface {
  std::uint32_t x = 0, y = 0;
  Vec3 position, normal, to_viewer;
  float depth = 0;  // metres
};

Surface surface_at(const RayScene& rays, const TracedView& view, std::uint32_t x, std::uint32_t y) {
  const PixelRay ray = pixel_ray(view.camera, float(x) + 0.5f, float(y) + 0.5f);
  const float depth = view.depth[view.view().at(x, y)];
  return {x,
          y,
          ray.origin_ws + depth * ray.direction_ws,
          rays.nearest(ray.origin_ws, ray.direction_ws).normal,
          normalised(-ray.direction_ws),
          depth};
}

// Returns random pixels that show a surface. A view that shows mostly sky gets fewer.
std::vector<Surface> any_surfaces(const RayScene& rays, const TracedView& view, std::uint32_t count,
                                  Random& random) {
  std::vector<Surface> chosen;
  for (std::uint32_t tries = 3 * count; chosen.size() < count && tries > 0; --tries) {
    const std::uint32_t x = random.below(view.camera.width), y = random.below(view.camera.height);
    if (view.view().has_surface(x, y)) chosen.push_back(surface_at(rays, view, x, y));
  }
  return chosen;
}

// Returns a random radius in metres. At the median depth of the chosen pixels, it covers 12 to 110 pixels.
float any_radius(const TracedView& view, std::vector<Surface> surfaces, Random& random) {
  const auto middle = surfaces.begin() + std::ptrdiff_t(surfaces.size() / 2);
  std::ranges::nth_element(surfaces, middle, {}, &Surface::depth);
  return random.log_between(12, 110) / std::abs(nook::nnao::pixel_scale(view.camera.rays, middle->depth).y);
}

// What the pass stores for a pixel: AO, bent normal and packed edges.
struct ScreenPixel {
  float ao = 1;
  Vec3 bent;
  std::uint8_t edges = 0;
};

// Computes pixels as the pass does before its filter. Pixels beyond the border and pixels without a surface
// are unoccluded.
class UnfilteredPass {
 public:
  UnfilteredPass(const nook::nnao::Network& network, const RayScene& rays, const TracedView& traced,
                 float radius, std::uint32_t taps)
      : network_(network),
        rays_(rays),
        traced_(traced),
        sampling_{radius, 0.5f * float(traced.camera.height), taps},
        edge_tolerance_(radius / sharpness) {}

  std::uint32_t taps() const { return sampling_.taps; }

  ScreenPixel at(int column, int row) const {
    const nook::nnao::View view = traced_.view();
    const std::uint32_t x = std::uint32_t(column), y = std::uint32_t(row);
    // Coordinates left of or above the screen wrap to large values.
    if (x >= view.width || y >= view.height || !view.has_surface(x, y)) return {};
    const Vec3 normal = view_direction(traced_.camera, surface_at(rays_, traced_, x, y).normal);
    const nook::nnao::Openness open =
        nook::nnao::evaluate_openness(network_, view, normal, sampling_, x, y, nook::nnao::tap_noise(x, y));
    return {std::clamp(open.ao, 0.0f, 1.0f), open.bent_normal,
            nook::nnao::packed_edges(nook::nnao::neighbours_of(view, x, y, edge_tolerance_).connected)};
  }

 private:
  static constexpr float sharpness = 16;  // nook_nnao_desc.blur_sharpness

  const nook::nnao::Network& network_;
  const RayScene& rays_;
  const TracedView& traced_;
  nook::nnao::Sampling sampling_;  // the radius is at most half the screen
  float edge_tolerance_;
};

constexpr int reach_px = nook::nnao::filter_reach_px;
using PixelLine = std::array<ScreenPixel, nook::nnao::filter_size_px>;

// Filters the middle pixel of a line along an axis. Does not change its edges.
ScreenPixel filtered_line(const PixelLine& pixels, nook::nnao::FilterAxis axis, std::uint32_t taps) {
  nook::nnao::FilterLine line;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    line.ao[i] = pixels[i].ao;
    line.edges[i] = pixels[i].edges;
  }
  const nook::nnao::FilterWeights weights =
      nook::nnao::filter_weights(line, axis, nook::nnao::filter_range_sharpness(taps, axis));
  ScreenPixel sum{0, {}, pixels[reach_px].edges};
  float whole = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    sum.ao += weights[i] * pixels[i].ao;
    sum.bent += weights[i] * pixels[i].bent;
    whole += weights[i];
  }
  sum.ao /= whole;
  sum.bent = sum.bent * (1 / whole);
  return sum;
}

// Returns the AO and the bent normal of a pixel after the pass's filter.
LitPixel filtered_pixel(const UnfilteredPass& pass, const TracedView& traced, const Surface& surface) {
  PixelLine column;
  for (int up = -reach_px; up <= reach_px; ++up) {
    PixelLine row;
    for (int aside = -reach_px; aside <= reach_px; ++aside)
      row[std::size_t(aside + reach_px)] = pass.at(int(surface.x) + aside, int(surface.y) + up);
    column[std::size_t(up + reach_px)] = filtered_line(row, nook::nnao::FilterAxis::x, pass.taps());
  }
  const ScreenPixel filtered = filtered_line(column, nook::nnao::FilterAxis::y, pass.taps());
  return {normalised(filtered.bent), view_direction(traced.camera, surface.normal),
          view_direction(traced.camera, surface.to_viewer), filtered.ao};
}

std::vector<SpecularSample> samples_of(const nook::nnao::Network& network, const RayScene& rays,
                                       const TracedView& view, const SpecularFitSettings& settings,
                                       std::uint64_t seed) {
  Random random(seed);
  const std::vector<Surface> surfaces = any_surfaces(rays, view, settings.data.points_per_view, random);
  std::vector<SpecularSample> samples;
  if (surfaces.empty()) return samples;
  const float radius = any_radius(view, surfaces, random);
  std::vector<Vec3> position, normal;
  std::vector<float> radii, offset;
  for (const Surface& surface : surfaces) {
    position.push_back(surface.position);
    normal.push_back(surface.normal);
    radii.push_back(radius);
    offset.push_back(origin_offset(surface.position, surface.depth, radius));
  }
  const Openness open =
      trace_openness(rays, {position, normal, radii, offset}, {.rays = settings.data.rays, .seed = seed});
  const UnfilteredPass pass(network, rays, view, radius, settings.taps);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    SpecularSample& sample = samples.emplace_back();
    sample.network = filtered_pixel(pass, view, surface);
    sample.reference = sample.network;
    sample.reference.ao = open.ao[i];
    const Vec3 bent = normalised(view_direction(view.camera, open.direction[i]));
    sample.reference.bent_normal = length(bent) > 0 ? bent : sample.reference.normal;
    const GlossyPoint glossy{surface.position, surface.normal, surface.to_viewer, radius, offset[i]};
    for (std::size_t g = 0; g < SpecularSample::gloss_count; ++g) {
      sample.roughness[g] = (float(g) + random.between(0.1f, 1)) / float(SpecularSample::gloss_count);
      sample.visible[g] =
          trace_specular_visibility(rays, glossy, sample.roughness[g], settings.rays, random.bits());
    }
  }
  return samples;
}

}  // namespace

SpecularSamples trace_specular_samples(const nook::nnao::Network& network,
                                       const SpecularFitSettings& settings, const DatasetProgress& progress) {
  const DatasetSettings& data = settings.data;
  std::vector<std::vector<SpecularSample>> samples(data.scenes);
  std::atomic<bool> cancelled{false};
  std::mutex progress_mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::uint32_t(0), data.scenes, [&](std::uint32_t s) {
    if (cancelled) return;
    const FlushDenormals flush;
    const TrainingScene scene = make_scene(data.seed, s);
    const RayScene rays(scene.soup);
    for (std::uint32_t v = s; v < data.views; v += data.scenes) {
      Random random(mix_bits(data.seed ^ mix_bits(v)));
      const TracedView view =
          trace_view(rays, place_training_camera(rays, scene, random, data.width, data.height));
      const auto found = samples_of(network, rays, view, settings, mix_bits(settings.seed ^ random.bits()));
      samples[s].insert(samples[s].end(), found.begin(), found.end());
    }
    if (!progress) return;
    const std::lock_guard lock(progress_mutex);
    if (!progress(++done, data.scenes)) cancelled = true;
  });
  if (cancelled) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing reflections");
  SpecularSamples result;
  const std::uint32_t first_validation = data.scenes - data.scenes / 6;
  for (std::uint32_t s = 0; s < data.scenes; ++s) {
    auto& part = s < first_validation ? result.training : result.validation;
    part.insert(part.end(), samples[s].begin(), samples[s].end());
  }
  return result;
}

}  // namespace nook::bake::nnao
