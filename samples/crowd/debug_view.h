// The views that are drawn over the crowd and show how its occlusion comes about.
#pragma once

#include <cstdint>

namespace crowd {

struct DebugView {
  bool spheres = false;     // the proxy spheres of bodies, coloured by bone
  bool key_points = false;  // the key points of bodies with their normals, coloured by their shadow
  bool links = false;       // a line from each caster to each body that it darkens
  bool levels = false;      // bodies in the colours of their levels of detail
  bool error = false;       // the AO of bodies against ray tracing
  // The bodies that spheres, key points and errors are shown for, the nearest to the camera first.
  std::uint32_t bodies = 1;
};

}  // namespace crowd
