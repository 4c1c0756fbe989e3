// Ray-traced AO of every pixel of a view, and the views that methods are measured on.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::bake::nnao {

// Returns AO from cosine-weighted rays around the geometric normal, as long as the radius (metres); 1 without
// a surface. The result is the same on any number of threads.
std::vector<float> trace_truth(const RayScene& rays, const TracedView& view, float radius,
                               std::uint32_t ray_count, std::uint64_t seed);

// Returns the expected squared error of such a reference: half the mean squared difference of two tracings of
// some pixels.
double truth_noise(const RayScene& rays, const TracedView& view, float radius, std::uint32_t ray_count,
                   std::uint64_t seed);

// Returns the camera whose image is the same but moved by one pixel: the content of x + 1 is at x.
Camera slid_by_one_pixel(Camera camera);

// Returns boxes for eyes and subjects of a scene with known triangles only: inside its bounds, where rays hit
// surfaces within a few metres.
TrainingScene scene_to_look_at(TriangleSoup soup);

}  // namespace nook::bake::nnao
