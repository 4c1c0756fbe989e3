// Traces the references of a view. Every pixel has AO, and some pixels have bent normals and specular
// occlusion.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::lab {

// Returns AO from cosine-weighted rays around the geometric normal. Rays end at the radius (metres). Pixels
// without a surface have AO 1. The result does not depend on the number of threads.
std::vector<float> trace_truth(const bake::RayScene& rays, const bake::nnao::TracedView& view, float radius,
                               std::uint32_t ray_count, std::uint64_t seed);

// Returns the expected squared error of a reference that trace_truth returns. To estimate it, traces some
// pixels twice and computes half the mean squared difference.
double truth_noise(const bake::RayScene& rays, const bake::nnao::TracedView& view, float radius,
                   std::uint32_t ray_count, std::uint64_t seed);

// Returns a camera whose image is shifted by one pixel: pixel x shows what pixel x + 1 showed before.
bake::nnao::Camera slid_by_one_pixel(bake::nnao::Camera camera);

// Makes a scene from the triangles, with a box for camera positions and a box for the subjects that cameras
// look at. The boxes are derived from the triangles only. They lie inside the scene's bounds, where rays hit
// surfaces within a few metres.
bake::nnao::TrainingScene scene_to_look_at(bake::TriangleSoup soup);

inline constexpr std::array<float, 5> measured_roughness{0.1f, 0.3f, 0.5f, 0.7f, 0.9f};

struct BentTruth {
  std::size_t pixel = 0;  // row by row
  float ao = 1;
  Vec3 bent_normal;  // view space, unit length; zero if nothing is open
  // The unoccluded share of the reflection towards the viewer, for each roughness of measured_roughness.
  std::array<float, measured_roughness.size()> specular{};
};

// Traces every stride-th pixel of every stride-th row, if the pixel has a surface. AO and bent normal use
// `ray_count` rays, and each reflection a quarter as many. All rays end at the radius (metres). The result
// does not depend on the number of threads.
std::vector<BentTruth> trace_bent_truth(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                        float radius, std::uint32_t ray_count, std::uint64_t seed,
                                        std::uint32_t stride);

}  // namespace nook::lab
