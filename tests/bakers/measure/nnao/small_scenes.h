// Scenes whose AO is known, traced into small G-buffers.
#pragma once

#include <memory>

#include "bakers/measure/nnao/baseline_pass.h"
#include "bakers/measure/nnao/measured_view.h"
#include "bakers/nnao/solids.h"
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

}  // namespace nook::test
