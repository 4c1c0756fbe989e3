#include "bakers/material/trace_material.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <mutex>
#include <span>

#include "bakers/material/raw_material.h"
#include "bakers/material/shading.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook::bake::material {
namespace {

void check(const TraceSettings& s, std::span<const Vec3> lights, std::span<const Vec3> views) {
  if (s.width < 1 || s.height < 1 || s.width > 4096 || s.height > 4096)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the texture has %u x %u texels; need 1 to 4096 on each side",
                  s.width, s.height);
  if (s.samples < 1 || s.samples > 16)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the number of samples along a texel's side is %u; need 1 to 16", s.samples);
  if (s.bounces > 0 && s.bounce_rays < 1)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "light that bounces needs rays (got 0 rays, need 1 or more); give rays, or set the bounces to 0");
  if (lights.empty() || views.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "directions are missing (got %zu lights and %zu views, need at least 1 of each)",
                  lights.size(), views.size());
  for (const auto& set : {lights, views})
    for (const Vec3 d : set)
      if (!(std::abs(length(d) - 1) < 1e-3f) || d.z < lowest_traced_z)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "direction (%g, %g, %g) is not a unit vector within 85 degrees of the normal",
                      double(d.x), double(d.y), double(d.z));
}

// Checks how much memory is needed before it is allocated. The BTF needs memory, and so do the light and the
// rays of inter-reflection at each vertex.
void check_memory(const TraceSettings& s, std::size_t lights, std::size_t views, std::size_t vertices) {
  constexpr double most_bytes = 16.0 * (1u << 30);
  const double btf = 3.0 * sizeof(float) * double(lights) * double(views) * s.width * s.height;
  const double vertex =
      s.bounces > 0 ? 7.0 * sizeof(float) * double(lights) + double(sizeof(SurfaceHit)) * s.bounce_rays : 0;
  const double bytes = btf + vertex * double(vertices);
  if (bytes > most_bytes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%zu lights, %zu views, %u x %u texels and %zu vertices take %.1f GiB, but at most %g GiB "
                  "are allowed; use fewer directions, texels or rays of inter-reflection",
                  lights, views, s.width, s.height, vertices, bytes / (1u << 30), most_bytes / (1u << 30));
}

// Traces one column of texels, which have the same x, from one view.
class Column {
 public:
  Column(const MesoSurface& surface, const TiledScene& scene, const InterReflection& indirect,
         RawMaterial& raw, std::vector<float>& coverage, std::uint32_t samples)
      : surface_(surface),
        scene_(scene),
        indirect_(indirect),
        raw_(raw),
        coverage_(coverage),
        samples_(samples) {}

  void trace(std::size_t view, std::uint32_t x) const {
    const std::size_t rows = raw_.light_rows(), height = raw_.height,
                      stride = raw_.views.size() * raw_.texels();
    const std::size_t first = (view * raw_.width + x) * height;
    std::vector<float> value(rows), sum(rows * height, 0.0f);
    LightScratch scratch;
    const auto per_texel = float(samples_ * samples_);
    for (std::uint32_t y = 0; y < raw_.height; ++y) {
      std::uint32_t met = 0;
      for (std::uint32_t s = 0; s < samples_ * samples_; ++s) {
        const SurfaceHit hit = look(raw_.views[view], x, y, s);
        if (hit.triangle == SurfaceHit::nothing) continue;
        ++met;
        shade(surface_, scene_, indirect_, hit, raw_.views[view], raw_.lights, value, scratch);
        for (std::size_t r = 0; r < rows; ++r) sum[r * height + y] += value[r] / per_texel;
      }
      coverage_[first + y] = float(met) / per_texel;
      raw_.mask[first + y] = 2 * met >= samples_ * samples_ ? 1.0f : 0.0f;
    }
    for (std::size_t r = 0; r < rows; ++r)
      std::copy_n(&sum[r * height], height, &raw_.btf[r * stride + first]);
  }

 private:
  SurfaceHit look(Vec3 view, std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    const auto inside = [this](std::uint32_t i) { return (float(i) + 0.5f) / float(samples_); };
    const Vec3 texel{(float(x) + inside(sample % samples_)) / float(raw_.width),
                     (float(y) + inside(sample / samples_)) / float(raw_.height), 0};
    // Starts just above the top, so that a ray never starts inside the solid.
    const Vec3 start = texel + ((scene_.top() + 1e-3f) / view.z) * view;
    return scene_.nearest({start.x - std::floor(start.x), start.y - std::floor(start.y), start.z}, -view);
  }

  const MesoSurface& surface_;
  const TiledScene& scene_;
  const InterReflection& indirect_;
  RawMaterial& raw_;
  std::vector<float>& coverage_;
  std::uint32_t samples_;
};

// For each texel, traces vertical rays from above through its samples. Returns the mean height at which they
// first meet the surface.
std::vector<float> heights_from_above(const TiledScene& scene, const TraceSettings& s) {
  const float start = scene.top() + 1e-3f;
  std::vector<float> heights(std::size_t(s.width) * s.height), coverage(heights.size());
  const auto per_texel = float(s.samples * s.samples);
  const auto at = [&](std::uint32_t texel, std::uint32_t sample, std::uint32_t count) {
    return (float(texel) + (float(sample) + 0.5f) / float(s.samples)) / float(count);
  };
  tbb::parallel_for(std::uint32_t{0}, s.width, [&](std::uint32_t x) {
    const FlushDenormals flush;
    for (std::uint32_t y = 0; y < s.height; ++y)
      for (std::uint32_t i = 0; i < s.samples * s.samples; ++i) {
        const Vec3 origin{at(x, i % s.samples, s.width), at(y, i / s.samples, s.height), start};
        const SurfaceHit hit = scene.nearest(origin, {0, 0, -1});
        if (hit.triangle == SurfaceHit::nothing) continue;
        heights[std::size_t(x) * s.height + y] += hit.position.z / per_texel;
        coverage[std::size_t(x) * s.height + y] += 1 / per_texel;
      }
  });
  fill_image_gaps(heights, coverage, s.width, s.height);
  return heights;
}

}  // namespace

void round_to_halves(RawMaterial& raw) {
  tbb::parallel_for(std::size_t{0}, raw.light_rows(), [&](std::size_t row) {
    const std::size_t size = raw.btf.size() / raw.light_rows();
    for (std::size_t i = row * size; i < (row + 1) * size; ++i) raw.btf[i] = from_half(to_half(raw.btf[i]));
  });
}

RawMaterial trace_material(const MesoSurface& surface, std::vector<Vec3> lights, std::vector<Vec3> views,
                           const TraceSettings& settings, const Progress& progress) {
  check(settings, lights, views);
  check_memory(settings, lights.size(), views.size(), surface.position.size());
  RawMaterial raw;
  raw.lights = std::move(lights);
  raw.views = std::move(views);
  raw.width = settings.width;
  raw.height = settings.height;
  raw.btf.resize(raw.light_rows() * raw.views.size() * raw.texels());
  raw.mask.resize(raw.views.size() * raw.texels());

  const TiledScene scene(surface);
  const InterReflection indirect(surface, scene, raw.lights, settings.bounce_rays, settings.bounces,
                                 settings.seed);
  std::vector<float> coverage(raw.mask.size());
  const Column column(surface, scene, indirect, raw, coverage, settings.samples);
  for (std::size_t view = 0; view < raw.views.size(); ++view) {
    if (progress && !progress(view, raw.views.size())) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
    tbb::parallel_for(std::uint32_t{0}, raw.width, [&](std::uint32_t x) {
      const FlushDenormals flush;
      column.trace(view, x);
    });
  }
  fill_gaps(raw, coverage);
  if (settings.finds_heights) raw.heights = heights_from_above(scene, settings);
  if (progress) progress(raw.views.size(), raw.views.size());
  round_to_halves(raw);
  return raw;
}

}  // namespace nook::bake::material
