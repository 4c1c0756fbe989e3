#include "bakers/lab/nnao/camera_path.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/affine.h"

namespace nook::lab {

using namespace bake::nnao;

namespace {

// Returns the median depth of the pixels with a surface, or 0 if there are none.
float median_depth(const TracedView& view) {
  std::vector<float> depths;
  for (const float depth : view.depth)
    if (std::isfinite(depth)) depths.push_back(depth);
  if (depths.empty()) return 0;
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

Camera moved(Camera camera, Vec3 along_vs) {
  const Vec3 eye = transform_point(camera.world_from_view, along_vs);
  float* m = camera.world_from_view.m;
  m[3] = eye.x;
  m[7] = eye.y;
  m[11] = eye.z;
  return camera;
}

// Returns the motion of the camera from a frame back to the frame before it, in view space.
Vec3 step_back(const bake::RayScene& rays, const TracedView& view, const PathSettings& settings) {
  const Mat3x4& world = view.camera.world_from_view;
  const float length = settings.step_px * std::abs(view.camera.rays.x_scale) * median_depth(view);
  const Vec3 eye = transform_point(world, {});
  Vec3 best{};
  float best_room = -1;
  for (const float side : {1.0f, -1.0f}) {
    const Vec3 back{side * length, 0, settings.forward * length};
    const Vec3 whole = float(settings.frames - 1) * back;
    // Finds the distance to the nearest wall in the direction of the path. The unit is the length of the
    // whole path, from the view to the oldest frame.
    const float room = length > 0 ? rays.nearest(eye, transform_vector(world, whole)).distance : 0.0f;
    if (room <= best_room) continue;
    best_room = room;
    // The path uses at most half of this distance, so that the camera does not get into the wall.
    best = std::min(1.0f, 0.5f * room) * back;
  }
  return best;
}

// Returns the depth difference to a neighbour along x plus the difference to a neighbour along y. On each
// axis, the neighbour with the smaller difference is used.
float depth_slope(const TracedView& view, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t width = view.camera.width, height = view.camera.height;
  const float depth = view.depth[std::size_t(y) * width + x];
  const auto change = [&](std::uint32_t column, std::uint32_t row) {
    return std::abs(view.depth[std::size_t(row) * width + column] - depth);  // infinite beside the sky
  };
  float across = INFINITY, up = INFINITY;
  if (x > 0) across = std::min(across, change(x - 1, y));
  if (x + 1 < width) across = std::min(across, change(x + 1, y));
  if (y > 0) up = std::min(up, change(x, y - 1));
  if (y + 1 < height) up = std::min(up, change(x, y + 1));
  return (std::isfinite(across) ? across : 0) + (std::isfinite(up) ? up : 0);
}

// Two depths count as the same surface if they differ by at most the slope plus this fraction of the depth.
// The fraction allows for curved surfaces.
constexpr float depth_share = 0.005f;

// The smallest total weight of matching pixels that is accepted. If the weight is smaller, the position only
// touches the border of the surface.
constexpr float smallest_share = 0.05f;

EarlierPixels pixels_at(const TracedView& before, Vec3 position, float tolerance) {
  EarlierPixels found;
  const Camera& camera = before.camera;
  const auto [x, y, in_image] = screen_place(camera, position);
  if (!in_image) return found;
  const float base_x = std::floor(x), base_y = std::floor(y);
  float total = 0;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const float aside = float(corner & 1), up = float(corner >> 1);
    const float column = base_x + aside, row = base_y + up;
    if (column < 0 || column >= float(camera.width) || row < 0 || row >= float(camera.height)) continue;
    const std::uint32_t pixel = std::uint32_t(row) * camera.width + std::uint32_t(column);
    if (!(std::abs(before.depth[pixel] + position.z) <= tolerance)) continue;
    found.pixel[corner] = pixel;
    found.weight[corner] = (1 - std::abs(x - column)) * (1 - std::abs(y - row));
    total += found.weight[corner];
  }
  for (float& weight : found.weight) weight = total > smallest_share ? weight / total : 0;
  return found;
}

}  // namespace

std::vector<Camera> path_cameras(const bake::RayScene& rays, const TracedView& view,
                                 const PathSettings& settings) {
  std::vector<Camera> cameras;
  if (settings.frames < 2) return cameras;
  const Vec3 back = step_back(rays, view, settings);
  for (std::size_t left = settings.frames - 1; left > 0; --left)
    cameras.push_back(moved(view.camera, float(left) * back));
  return cameras;
}

std::vector<TracedView> trace_path(const bake::RayScene& rays, const TracedView& view,
                                   const PathSettings& settings) {
  std::vector<TracedView> frames;
  for (const Camera& camera : path_cameras(rays, view, settings)) frames.push_back(trace_view(rays, camera));
  return frames;
}

ScreenPlace screen_place(const Camera& camera, Vec3 position) {
  const float extent = camera.rays.orthographic ? 1 : -position.z;
  const float x = (position.x / extent - camera.rays.x_offset) / camera.rays.x_scale - 0.5f,
              y = (position.y / extent - camera.rays.y_offset) / camera.rays.y_scale - 0.5f;
  return {x, y, extent > 0 && x > -1 && x < float(camera.width) && y > -1 && y < float(camera.height)};
}

Mat3x4 earlier_from_view(const Camera& now, const Camera& before) {
  return to_float(inverse(to_double(before.world_from_view)) * to_double(now.world_from_view));
}

std::vector<EarlierPixels> earlier_pixels(const TracedView& now, const TracedView& before) {
  const Mat3x4 earlier = earlier_from_view(now.camera, before.camera);
  std::vector<EarlierPixels> pixels(now.depth.size());
  for (std::uint32_t y = 0; y < now.camera.height; ++y)
    for (std::uint32_t x = 0; x < now.camera.width; ++x) {
      const std::size_t i = std::size_t(y) * now.camera.width + x;
      const float depth = now.depth[i];
      if (!std::isfinite(depth)) continue;
      const Vec3 position =
          nook::nnao::view_position(now.camera.rays, float(x) + 0.5f, float(y) + 0.5f, depth);
      pixels[i] =
          pixels_at(before, transform_point(earlier, position), depth_slope(now, x, y) + depth_share * depth);
    }
  return pixels;
}

}  // namespace nook::lab
