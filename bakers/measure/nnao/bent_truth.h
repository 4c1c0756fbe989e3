// The references of bent normals and of specular occlusion at pixels of a view.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::measure {

inline constexpr std::array<float, 5> measured_roughness{0.1f, 0.3f, 0.5f, 0.7f, 0.9f};

struct BentTruth {
  std::size_t pixel = 0;  // row by row
  float ao = 1;
  Vec3 bent_normal;  // view space, unit length; zero where nothing is open
  // The open share of the reflection to the viewer, for each roughness of measured_roughness.
  std::array<float, measured_roughness.size()> specular{};
};

// Every stride-th pixel of every stride-th row that has a surface. AO and bent normal have ray_count rays, a
// reflection a quarter as many; all are as long as the radius (metres). The result is the same on any number
// of threads.
std::vector<BentTruth> trace_bent_truth(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                        float radius, std::uint32_t ray_count, std::uint64_t seed,
                                        std::uint32_t stride);

}  // namespace nook::measure
