// Scenes whose AO is known, traced into small G-buffers.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "bakers/measure/nnao/gpu_image.h"
#include "bakers/nnao/solids.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "platform/platform.h"

namespace nook::test {

inline constexpr int width = 96, height = 64;

inline std::unique_ptr<platform::Context> make_context() {
  platform::ContextRequest request;
  request.major = request.minor = 3;
  return platform::create_context(request);
}

// A plane far wider than any radius here, seen from above at 45 degrees.
inline bake::TriangleSoup plane() {
  bake::TriangleSoup soup;
  bake::nnao::add_quad(soup, {-90, 0, -90}, {90, 0, -90}, {90, 0, 90}, {-90, 0, 90});
  return soup;
}

// Two such planes that meet at a right angle in the line x = anything, y = z = 0.
inline bake::TriangleSoup corner() {
  bake::TriangleSoup soup;
  bake::nnao::add_quad(soup, {-90, 0, 0}, {90, 0, 0}, {90, 0, 90}, {-90, 0, 90});
  bake::nnao::add_quad(soup, {-90, 0, 0}, {90, 0, 0}, {90, 90, 0}, {-90, 90, 0});
  return soup;
}

// Looks at the origin, both planes of the corner equally inclined to it.
inline bake::nnao::Camera camera(float distance = 3) {
  const float side = distance * 0.70710678f;
  return bake::nnao::look_at({0, side, side}, {0, 0, 0}, 0, 0.8f, width, height);
}

inline bake::nnao::TracedView traced(const bake::TriangleSoup& soup, const bake::nnao::Camera& from) {
  return bake::nnao::trace_view(bake::RayScene(soup), from);
}

// The AO of each pixel by rays as long as the radius; 1 without a surface.
inline std::vector<float> traced_ao(const bake::TriangleSoup& soup, const bake::nnao::TracedView& view,
                                    float radius, std::uint32_t rays) {
  std::vector<std::size_t> pixels;
  std::vector<Vec3> position, normal;
  for (std::size_t i = 0; i < view.depth.size(); ++i) {
    if (!std::isfinite(view.depth[i])) continue;
    const bake::nnao::PixelRay ray =
        bake::nnao::pixel_ray(view.camera, float(i % width) + 0.5f, float(i / width) + 0.5f);
    pixels.push_back(i);
    position.push_back(ray.origin_ws + view.depth[i] * ray.direction_ws);
    normal.push_back(transform_vector(view.camera.world_from_view, view.normal[i]));
  }
  bake::AoSettings settings;
  settings.rays = rays;
  settings.radius = radius;
  settings.origin_offset = 3e-4f;  // far above the rounding of hits a few metres away
  const std::vector<float> traced = bake::trace_ao(bake::RayScene(soup), {position, normal}, settings);
  std::vector<float> ao(view.depth.size(), 1.0f);
  for (std::size_t i = 0; i < traced.size(); ++i) ao[pixels[i]] = traced[i];
  return ao;
}

}  // namespace nook::test
