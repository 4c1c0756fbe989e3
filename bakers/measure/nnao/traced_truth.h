// Ray-traced AO of every pixel of a view, and the views that methods are measured on.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::bake::nnao {

// Cosine-weighted round the geometric normal, rays as long as the radius (metres); 1 without a surface. The
// same on any number of threads.
std::vector<float> trace_truth(const RayScene& rays, const TracedView& view, float radius,
                               std::uint32_t ray_count, std::uint64_t seed);

// The expected squared error of such a truth: half the mean squared difference of two tracings of some
// pixels.
double truth_noise(const RayScene& rays, const TracedView& view, float radius, std::uint32_t ray_count,
                   std::uint64_t seed);

// The camera whose image is the same but slides by one pixel: what was at x + 1 is at x.
Camera slid_by_one_pixel(Camera camera);

// Eyes and subjects for a scene of which only the triangles are known: inside its bounds, where rays meet
// surfaces within a few metres.
TrainingScene scene_to_look_at(TriangleSoup soup);

}  // namespace nook::bake::nnao
