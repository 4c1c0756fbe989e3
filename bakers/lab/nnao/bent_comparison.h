// Compares bent normals and specular occlusion with ray tracing, for the methods that produce them.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/lab/nnao/baseline_pass.h"
#include "bakers/lab/nnao/measured_view.h"
#include "platform/platform.h"
#include "sdk/src/core/vec.h"

namespace nook::lab {

// Runs one pass of XeGTAO's edge-aware denoiser on an image of vectors, on the CPU. The weights are those of
// shaders/denoise.glsl. `vectors` is stored row by row. `packed_edges` has values in [0, 1], packed as in
// shaders/edges.glsl. Set `last` for the last pass, in which the pixel itself has more weight. The resulting
// vectors have unit length or are zero.
std::vector<Vec3> edge_average(std::span<const Vec3> vectors, std::span<const float> packed_edges,
                               std::uint32_t width, bool last);

// Angles and errors are measured only at pixels whose reference AO is below this value. Elsewhere, the
// surface normal is good enough.
inline constexpr float bent_below = 0.7f;

// Returns the rows of each source, and the means over the sources. The columns are
//   method, taps, denoiser, scene
//   angle           degrees, the median where the reference's AO is below bent_below
//   angle_mean      degrees
//   specular_mse    this and the columns below: only for methods with AO
//   lagarde_mse     by S. Lagarde's form of the same AO
//   specular_ratio  and both errors for each roughness
// All views must have the same size and must contain bent references. The radius of `request` is replaced by
// the radius of each view. The methods are the surface normal, the reference itself, the library with the tap
// counts of its presets, and XeGTAO with its denoiser. `progress` counts methods. If it returns false, the
// function throws Failure(CANCELLED).
nlohmann::ordered_json bent_rows(platform::Context& context, std::span<const MeasuredView> views,
                                 measure::AoRequest request,
                                 const std::function<bool(std::size_t, std::size_t)>& progress);

std::string bent_markdown(const nlohmann::ordered_json& rows);

}  // namespace nook::lab
