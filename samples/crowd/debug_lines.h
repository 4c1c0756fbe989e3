// Draws the occluders of the crowd as lines over its picture, using nook_debug.h.
#pragma once

#include "samples/crowd/crowd_scene.h"

namespace crowd {

struct DebugView {
  bool spheres = false;  // the proxy spheres of bodies, coloured by bone
  bool links = false;    // a line from each caster to each body that it darkens
  int bodies = 1;        // number of bodies whose spheres are shown, nearest to the camera first
};

// Draws over everything but ImGui's panels, within an ImGui frame. Spheres and links come from the last
// update.
void draw_debug_lines(const CrowdScene& scene, const Camera& camera, const DebugView& view);

}  // namespace crowd
