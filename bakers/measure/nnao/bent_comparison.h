// Bent normals and specular occlusion of the methods that have them, against ray tracing.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "bakers/measure/nnao/baseline_pass.h"
#include "bakers/measure/nnao/measured_view.h"
#include "platform/platform.h"

namespace nook::measure {

// Degrees and errors count where the reference's AO is below this: elsewhere the normal serves as well.
inline constexpr float bent_below = 0.7f;

// Rows of each source and their means: method, taps, denoiser, scene, angle (degrees, the median where the
// reference's AO is below bent_below), angle_mean, and, of methods with AO, specular_mse, lagarde_mse (of S.
// Lagarde's form of the same AO), specular_ratio, and the same two errors for each roughness. Views have one
// size and bent references; request's radius is each view's. Methods: the normal, the reference itself, the
// library with its presets' taps, and XeGTAO with its denoiser. progress counts methods; false stops, which
// throws Failure(CANCELLED).
nlohmann::ordered_json bent_rows(platform::Context& context, std::span<const MeasuredView> views,
                                 AoRequest request,
                                 const std::function<bool(std::size_t, std::size_t)>& progress);

// The table of the means.
std::string bent_markdown(const nlohmann::ordered_json& rows);

}  // namespace nook::measure
