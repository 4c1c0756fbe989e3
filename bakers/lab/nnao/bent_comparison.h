// Bent normals and specular occlusion of the methods that have them, against ray tracing.
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

// One pass of XeGTAO's edge-aware denoiser over vectors, on the CPU, with the weights of
// shaders/denoise.glsl. vectors: row by row. packed_edges: those of shaders/edges.glsl, in [0, 1]. last:
// whether no pass follows, which gives the pixel itself more weight. Results have unit length, or are zero.
std::vector<Vec3> edge_average(std::span<const Vec3> vectors, std::span<const float> packed_edges,
                               std::uint32_t width, bool last);

// Degrees and errors count where the reference's AO is below this: elsewhere the normal serves as well.
inline constexpr float bent_below = 0.7f;

// Rows of each source and their means: method, taps, denoiser, scene, angle (degrees, the median where the
// reference's AO is below bent_below), angle_mean, and, of methods with AO, specular_mse, lagarde_mse (of S.
// Lagarde's form of the same AO), specular_ratio, and the same two errors for each roughness. Views have one
// size and bent references; request's radius is each view's. Methods: the normal, the reference itself, the
// library with its presets' taps, and XeGTAO with its denoiser. progress counts methods; false stops, which
// throws Failure(CANCELLED).
nlohmann::ordered_json bent_rows(platform::Context& context, std::span<const MeasuredView> views,
                                 measure::AoRequest request,
                                 const std::function<bool(std::size_t, std::size_t)>& progress);

// The table of the means.
std::string bent_markdown(const nlohmann::ordered_json& rows);

}  // namespace nook::lab
