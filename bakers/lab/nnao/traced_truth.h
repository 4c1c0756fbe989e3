// Ray-traced references of a view: AO of every pixel, bent normals and specular occlusion of some.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::lab {

// Returns AO from cosine-weighted rays around the geometric normal, as long as the radius (metres); 1 without
// a surface. The result is the same on any number of threads.
std::vector<float> trace_truth(const bake::RayScene& rays, const bake::nnao::TracedView& view, float radius,
                               std::uint32_t ray_count, std::uint64_t seed);

// Returns the expected squared error of such a reference: half the mean squared difference of two tracings of
// some pixels.
double truth_noise(const bake::RayScene& rays, const bake::nnao::TracedView& view, float radius,
                   std::uint32_t ray_count, std::uint64_t seed);

// Returns the camera whose image is moved by one pixel: the content of x + 1 is at x.
bake::nnao::Camera slid_by_one_pixel(bake::nnao::Camera camera);

// Returns boxes for eyes and subjects of a scene, from its triangles only: inside its bounds, where rays hit
// surfaces within a few metres.
bake::nnao::TrainingScene scene_to_look_at(bake::TriangleSoup soup);

inline constexpr std::array<float, 5> measured_roughness{0.1f, 0.3f, 0.5f, 0.7f, 0.9f};

struct BentTruth {
  std::size_t pixel = 0;  // row by row
  float ao = 1;
  Vec3 bent_normal;  // view space, unit length; zero if nothing is open
  // The open share of the reflection to the viewer, for each roughness of measured_roughness.
  std::array<float, measured_roughness.size()> specular{};
};

// Traces every stride-th pixel of every stride-th row that has a surface. AO and bent normal use ray_count
// rays, and a reflection a quarter as many. All are as long as the radius (metres). The result is the same on
// any number of threads.
std::vector<BentTruth> trace_bent_truth(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                        float radius, std::uint32_t ray_count, std::uint64_t seed,
                                        std::uint32_t stride);

}  // namespace nook::lab
