#include "bakers/measure/composite/room_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/raytrace/hemisphere.h"
#include "platform/platform.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr float origin_offset_m = 3e-4f;

void trace_buffers(const PopulatedRoom& room, const RayScene& all, RoomView& view) {
  const bake::nnao::Camera& camera = view.view.camera;
  const std::size_t pixels = std::size_t(camera.width) * camera.height;
  view.view.depth.resize(pixels);
  view.view.normal.resize(pixels);
  view.is_figure.resize(pixels);
  tbb::parallel_for(0u, camera.height, [&](std::uint32_t y) {
    const FlushDenormals flush;
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const bake::nnao::PixelRay ray = bake::nnao::pixel_ray(camera, float(x) + 0.5f, float(y) + 0.5f);
      const RayHit hit = all.nearest(ray.origin_ws, ray.direction_ws);
      const std::size_t i = std::size_t(y) * camera.width + x;
      view.view.depth[i] = hit.distance;
      view.view.normal[i] = bake::nnao::view_direction(camera, hit.normal);
      view.is_figure[i] = std::isfinite(hit.distance) && hit.triangle >= room.first_figure;
    }
  });
}

// The number of open rays in each half of the rays.
struct Open {
  int room = 0, together = 0;
};

void add_ray(Open& open, const PopulatedRoom& room, const RayScene& all, Vec3 origin, Vec3 direction,
             float radius) {
  bool met_figure = false;
  float beyond = 0;
  // After the ray has hit a figure, only hits on the room are counted.
  for (;;) {
    const RayHit hit = all.nearest(origin, direction, beyond);
    const bool figure = std::isfinite(hit.distance) && hit.triangle >= room.first_figure;
    if (figure) {
      met_figure = true;
      beyond = hit.distance;
      if (beyond <= radius) continue;
    } else if (hit.distance <= radius) {
      return;
    }
    break;
  }
  ++open.room;
  open.together += !met_figure;
}

}  // namespace

RoomView trace_room_view(const PopulatedRoom& room, const RayScene& all, const bake::nnao::Camera& camera,
                         const RoomTruth& truth) {
  RoomView view{{camera, {}, {}}, {}, {}};
  trace_buffers(room, all, view);
  RoomPixels& p = view.pixels;
  for (std::size_t i = truth.every / 2; i < view.view.depth.size(); i += truth.every) {
    if (!std::isfinite(view.view.depth[i]) || view.is_figure[i]) continue;
    const bake::nnao::PixelRay ray =
        bake::nnao::pixel_ray(camera, float(i % camera.width) + 0.5f, float(i / camera.width) + 0.5f);
    p.pixel.push_back(std::uint32_t(i));
    p.position.push_back(ray.origin_ws + view.view.depth[i] * ray.direction_ws);
    p.normal.push_back(transform_vector(camera.world_from_view, view.view.normal[i]));
  }
  for (int half = 0; half < 2; ++half) {
    p.room[half].resize(p.pixel.size());
    p.together[half].resize(p.pixel.size());
    const HemispherePatterns patterns(std::max(truth.rays / 2, 1u),
                                      mix_bits(truth.seed) + std::uint64_t(half));
    tbb::parallel_for(std::size_t(0), p.pixel.size(), [&](std::size_t i) {
      const FlushDenormals flush;
      const std::uint64_t bits = mix_bits(truth.seed ^ mix_bits(2 * i + std::uint64_t(half)));
      const float angle = 6.2831853f * unit_float(bits);
      const Frame frame = turned_frame(p.normal[i], std::cos(angle), std::sin(angle));
      const Vec3* const local = patterns.pattern(std::uint32_t(bits));
      const Vec3 origin = p.position[i] + origin_offset_m * p.normal[i];
      Open open;
      for (std::uint32_t r = 0; r < patterns.rays(); ++r)
        add_ray(open, room, all, origin, to_world(frame, local[r]), truth.radius);
      p.room[half][i] = float(open.room) / float(patterns.rays());
      p.together[half][i] = float(open.together) / float(patterns.rays());
    });
  }
  return view;
}

namespace {

using Rgb = std::array<float, 3>;

// Returns the mean of 2 x 2 pixels.
Rgb shown(const RoomView& view, const std::vector<float>& ao, std::size_t x, std::size_t y) {
  constexpr Rgb blue{0.30f, 0.36f, 0.46f};
  Rgb sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t i = (2 * y + k / 2) * view.view.camera.width + 2 * x + k % 2;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += 0.25f * (view.is_figure[i] ? blue[c] : ao[i]);
  }
  return sum;
}

}  // namespace

void write_room_picture(const std::filesystem::path& file, const RoomView& view,
                        std::span<const std::vector<float>> panels) {
  const std::size_t width = view.view.camera.width / 2, height = view.view.camera.height / 2;
  platform::Image image;
  image.width = int(width * panels.size());
  image.height = int(height);
  image.channels = 3;
  for (std::size_t y = 0; y < height; ++y)
    for (const std::vector<float>& ao : panels)
      for (std::size_t x = 0; x < width; ++x)
        for (const float channel : shown(view, ao, x, height - 1 - y))
          image.pixels.push_back(std::uint8_t(std::lround(255 * std::clamp(channel, 0.0f, 1.0f))));
  platform::write_image(file, image);
}

}  // namespace nook::measure
