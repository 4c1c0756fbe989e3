#include "bakers/measure/transfer/transfer_pictures.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "bakers/transfer/surface_holes.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/material/reflectance.h"

namespace nook::measure {
namespace {

using bake::Picture;
using nook::transfer::Frame;

constexpr float pi = std::numbers::pi_v<float>;
constexpr float elevation_deg = 35, azimuth_deg = 30, field_of_view_deg = 34;

struct Camera {
  Vec3 eye, forward, right, up;
  float width = 0, height = 0;  // size of the picture at a distance of 1
};

Camera camera_of(const bake::SurfaceMesh& mesh, const PictureSettings& settings) {
  Vec3 low = mesh.position[0], high = low;
  for (const Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 middle = (low + high) * 0.5f;
  const float radius = 0.5f * length(high - low);
  const float elevation = elevation_deg * pi / 180, azimuth = azimuth_deg * pi / 180;
  const Vec3 away{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  std::cos(elevation) * std::cos(azimuth)};
  Camera camera;
  const float half = std::tan(0.5f * field_of_view_deg * pi / 180);
  camera.eye = middle + away * (0.95f * radius / std::sin(0.5f * field_of_view_deg * pi / 180));
  camera.forward = -away;
  camera.right = normalised(cross(camera.forward, {0, 1, 0}));
  camera.up = cross(camera.right, camera.forward);
  camera.height = 2 * half;
  camera.width = camera.height * float(settings.width) / float(settings.height);
  return camera;
}

// The surface that a pixel shows.
struct PixelHit {
  bool is_hit = false;
  std::array<std::uint32_t, 3> vertex{};
  std::array<float, 3> weight{};
  Vec3 origin;  // where rays to the light start
  Frame frame;
  std::vector<float> modes;  // the material, decoded for the pixel's view
  std::vector<float> raw;    // the same from the raw material, if the reference uses it
};

class Renderer {
 public:
  Renderer(const PictureSource& source, const PictureSettings& settings)
      : source_(source),
        settings_(settings),
        camera_(camera_of(source.mesh, settings)),
        rays_({source.mesh.position, source.mesh.triangle}),
        offset_(bake::ray_origin_offset(source.mesh.position)),
        sampler_(source.map) {
    // A light ray does not have a footprint, so holes are looked up at the finest level.
    if (settings.truth.holes) holes_.emplace(source.mesh, *settings.truth.holes, settings.truth.tiles, 0.0f);
  }

  PixelHit hit(int column, int row) const {
    const float x = ((float(column) + 0.5f) / float(settings_.width) - 0.5f) * camera_.width;
    const float y = (0.5f - (float(row) + 0.5f) / float(settings_.height)) * camera_.height;
    const Vec3 direction = normalised(camera_.forward + camera_.right * x + camera_.up * y);
    const bake::RayHit found = rays_.nearest(camera_.eye, direction);
    if (std::isinf(found.distance)) return {};
    return surface_at(found, camera_.eye, direction, true);
  }

  // Returns one estimate of the light from two samples, one of the map and one of the hemisphere, combined
  // with the balance heuristic (E. Veach 1997). If the hemisphere sample hits a surface, the path continues
  // there, up to `bounces` times.
  Vec3 sample(const PixelHit& hit, std::uint32_t bounces, bake::Random& random) const {
    const double choice = random.unit_double();
    const float alias = random.unit(), u = random.unit(), v = random.unit();
    const bake::LightSample light = sampler_.sample(choice, alias, u, v);
    Vec3 sum = reflected(hit, light.direction, light.radiance * share_of_sky(hit.origin, light.direction),
                         light.density);
    const float s = random.unit(), t = random.unit();
    const Vec3 around = bake::cosine_direction(s, t);
    const Vec3 direction =
        hit.frame.tangent * around.x + hit.frame.bitangent() * around.y + hit.frame.normal * around.z;
    bake::RayHit found;
    const bool is_sky = !next_surface(hit.origin, direction, random, found);
    if (is_sky)
      return sum + reflected(hit, direction, source_.map.radiance(direction), sampler_.density(direction));
    if (bounces == 0) return sum;
    const PixelHit next = surface_at(found, hit.origin, direction, false);
    if (!next.is_hit) return sum;
    return sum + reflected(hit, direction, sample(next, bounces - 1, random), 0);
  }

  Vec3 shaded(const PixelHit& hit, TransferForm form) const {
    const std::vector<float>& vectors = source_.vectors.lights[source_.light].form[std::size_t(form)];
    const std::size_t modes = hit.modes.size();
    float sum[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const float* const vector = &vectors[hit.vertex[k] * 3 * modes];
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t a = 0; a < modes; ++a)
          sum[c] += hit.weight[k] * hit.modes[a] * vector[c * modes + a];
    }
    return {sum[0], sum[1], sum[2]};
  }

 private:
  // Returns the surface that a ray hit, with the material decoded for the direction of the ray. Camera rays
  // use the mipmap level of the pixel's footprint, and other rays use the finest level.
  PixelHit surface_at(const bake::RayHit& found, Vec3 from, Vec3 direction, bool is_pixel) const {
    PixelHit hit;
    const bake::SurfaceMesh& mesh = source_.mesh;
    hit.vertex = mesh.triangle[found.triangle];
    hit.weight = {1 - found.u - found.v, found.u, found.v};
    Vec3 normal, tangent;
    float u = 0, v = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t at = hit.vertex[k];
      normal += mesh.normal[at] * hit.weight[k];
      tangent += mesh.tangent[at].direction * hit.weight[k];
      u += mesh.uv[at].u * hit.weight[k];
      v += mesh.uv[at].v * hit.weight[k];
    }
    hit.frame = nook::transfer::orthonormal_frame(normal, tangent, mesh.tangent[hit.vertex[0]].handedness);
    // The inside of a surface is not lit.
    if (dot(found.normal, hit.frame.normal) <= 0 && found.from_behind) return hit;
    hit.is_hit = true;
    hit.origin = from + direction * found.distance + hit.frame.normal * offset_;
    nook::material::Sample sample;
    sample.u = u * settings_.truth.tiles;
    sample.v = v * settings_.truth.tiles;
    sample.level = is_pixel ? level(hit, direction, found.distance) : 0;
    sample.view = local(hit.frame, -direction);
    if (source_.raw) {
      hit.raw.resize(source_.raw->number_count());
      source_.raw->decode(sample, hit.raw);
      if (!is_pixel) return hit;
    }
    hit.modes.resize(source_.tables.btf.light_modes);
    nook::material::decode_modes(source_.tables, sample, hit.modes);
    return hit;
  }

  static Vec3 local(const Frame& frame, Vec3 d) {
    return {dot(frame.tangent, d), dot(frame.bitangent(), d), dot(frame.normal, d)};
  }

  // Returns log2 of the number of texels that a pixel covers along a side. It is derived from the ratio of
  // the triangle's area in texels to its area on the surface.
  float level(const PixelHit& hit, Vec3 direction, float distance) const {
    const bake::SurfaceMesh& mesh = source_.mesh;
    const Vec3 p = mesh.position[hit.vertex[0]];
    const Vec3 a = mesh.position[hit.vertex[1]] - p, b = mesh.position[hit.vertex[2]] - p;
    const auto& t = mesh.uv[hit.vertex[0]];
    const float du1 = mesh.uv[hit.vertex[1]].u - t.u, dv1 = mesh.uv[hit.vertex[1]].v - t.v;
    const float du2 = mesh.uv[hit.vertex[2]].u - t.u, dv2 = mesh.uv[hit.vertex[2]].v - t.v;
    const float texels = std::abs(du1 * dv2 - du2 * dv1) * settings_.truth.tiles * settings_.truth.tiles *
                         float(source_.tables.btf.width * source_.tables.btf.height);
    const float area = length(cross(a, b)), pixel = distance * camera_.height / float(settings_.height);
    const float cosine = std::max(std::abs(dot(direction, hit.frame.normal)), 0.05f);
    const float covered = texels * pixel * pixel / (std::max(area, 1e-20f) * cosine);
    return 0.5f * std::log2(std::max(covered, 1e-10f));
  }

  float share_of_sky(Vec3 origin, Vec3 direction) const {
    if (!rays_.occluded(origin, direction)) return 1;
    return holes_ ? holes_->share_through(rays_, origin, direction) : 0.0f;
  }

  // Finds the surface that stops a ray. At holes, a random choice decides whether the ray passes.
  bool next_surface(Vec3 origin, Vec3 direction, bake::Random& random, bake::RayHit& found) const {
    for (float beyond = 0;; beyond = found.distance) {
      found = rays_.nearest(origin, direction, beyond);
      if (std::isinf(found.distance)) return false;
      if (!holes_ || random.unit() < holes_->cover(found, direction)) return true;
    }
  }

  // Returns the light from a direction that is sampled both with `light_density` and with the cosine.
  Vec3 reflected(const PixelHit& hit, Vec3 direction, Vec3 radiance, float light_density) const {
    const Vec3 at = local(hit.frame, direction);
    if (!(at.z > 0) || (radiance.x == 0 && radiance.y == 0 && radiance.z == 0)) return {};
    const float density = light_density + at.z / pi;
    if (!(density > 0)) return {};
    if (source_.raw) return by_channel(source_.raw->radiance(hit.raw, at), radiance) * (1 / density);
    const std::size_t modes = hit.modes.size();
    float basis[3 * 1024];
    nook::material::light_basis_at(source_.tables, at, std::span(basis, 3 * modes));
    float sum[3] = {};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < modes; ++a) sum[c] += hit.modes[a] * basis[c * modes + a];
    return by_channel({sum[0], sum[1], sum[2]}, radiance) * (1 / density);
  }

  const PictureSource& source_;
  const PictureSettings& settings_;
  Camera camera_;
  bake::RayScene rays_;
  float offset_;
  bake::LightSampler sampler_;
  std::optional<bake::transfer::SurfaceHoles> holes_;
};

// Linear radiance of all pixels. The reference consists of two halves that are traced independently.
struct Images {
  std::vector<bool> is_hit;
  std::array<std::vector<Vec3>, 2> truth;
  std::array<std::vector<Vec3>, 3> form;
};

std::uint8_t display(float linear) {
  const float value = std::clamp(linear, 0.0f, 1.0f);
  const float encoded = value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
  return std::uint8_t(std::lround(255 * encoded));
}

Picture picture_of(const Images& images, const std::vector<Vec3>& linear, float exposure, int width,
                   int height) {
  Picture picture{width, height, {}};
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const Vec3 c = linear[i] * exposure;
    for (const float channel : {c.x, c.y, c.z})
      picture.rgb.push_back(images.is_hit[i] ? display(channel) : std::uint8_t(54));
  }
  return picture;
}

double squared(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return double(dot(d, d)) / 3;
}

}  // namespace

PictureError measure_pictures(const PictureSource& source, const PictureSettings& settings,
                              const VectorProgress& progress) {
  const Renderer renderer(source, settings);
  const std::size_t pixels = std::size_t(settings.width) * std::size_t(settings.height);
  Images images;
  std::vector<std::uint8_t> is_hit(pixels);
  for (auto* set : {&images.truth[0], &images.truth[1], &images.form[0], &images.form[1], &images.form[2]})
    set->resize(pixels);
  std::atomic<bool> cancelled{false};
  std::mutex progress_mutex;
  std::size_t done = 0;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, settings.height, 1),
      [&](const auto& range) {
        const bake::FlushDenormals flush;
        for (int row = range.begin(); row < range.end() && !cancelled; ++row)
          for (int column = 0; column < settings.width; ++column) {
            const PixelHit hit = renderer.hit(column, row);
            if (!hit.is_hit) continue;
            const std::size_t i = std::size_t(row) * std::size_t(settings.width) + std::size_t(column);
            is_hit[i] = 1;
            bake::Random random(bake::mix_bits(settings.seed ^ bake::mix_bits(i)));
            const std::uint32_t half = settings.paths / 2;
            for (std::vector<Vec3>& truth : images.truth) {
              for (std::uint32_t s = 0; s < half; ++s)
                truth[i] += renderer.sample(hit, settings.truth.bounces, random);
              truth[i] = truth[i] * (1 / float(half));
            }
            for (std::size_t form = 0; form < 3; ++form)
              images.form[form][i] = renderer.shaded(hit, TransferForm(form));
          }
        const std::lock_guard lock(progress_mutex);
        done += range.size();
        if (progress && !cancelled && !progress(done, std::size_t(settings.height))) cancelled = true;
      },
      tbb::simple_partitioner());
  if (cancelled) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while path tracing");
  images.is_hit.assign(is_hit.begin(), is_hit.end());

  PictureError error;
  std::vector<Vec3> truth(pixels);
  double luminance = 0, count = 0, noise = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!images.is_hit[i]) continue;
    truth[i] = (images.truth[0][i] + images.truth[1][i]) * 0.5f;
    luminance += double(bake::luminance(truth[i]));
    count += 1;
    // The variance of the mean of two halves is a quarter of the variance of their difference.
    noise += squared(images.truth[0][i], images.truth[1][i]) / 4;
  }
  if (count == 0) return error;
  const double mean = std::max(luminance / count, 1e-30), unit = 1 / (count * mean * mean);
  error.noise_floor_mse = noise * unit;
  for (std::size_t form = 0; form < 3; ++form) {
    double sum = 0;
    for (std::size_t i = 0; i < pixels; ++i)
      if (images.is_hit[i]) sum += squared(truth[i], images.form[form][i]);
    error.mse[form] = (sum - noise) * unit;
  }
  const float exposure = float(0.25 / mean);
  std::vector<Picture> parts{picture_of(images, truth, exposure, settings.width, settings.height)};
  for (const std::vector<Vec3>& form : images.form)
    parts.push_back(picture_of(images, form, exposure, settings.width, settings.height));
  error.sheet = bake::side_by_side(parts);
  return error;
}

}  // namespace nook::measure
