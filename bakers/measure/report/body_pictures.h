// Pictures of a body with its error, ray traced without a display.
#pragma once

#include <span>
#include <vector>

#include "bakers/images/picture.h"
#include "bakers/measure/report/body_findings.h"

namespace nook::report {

// AO at the far end of the colours of an error.
inline constexpr float error_end = 0.25f;

// The direction to a viewer who sees most of the error of the given vertices, of 24 that are spread over the
// sphere but its poles. Faces that others hide do not count.
Vec3 view_of_error(const bake::SkinnedMesh& mesh, std::span<const Vec3> posed,
                   std::span<const std::uint32_t> vertices, std::span<const float> error);

// Eight pictures of the rest pose from sides that are 45 degrees apart, from the front on to the body's left.
std::vector<bake::Picture> eight_sides(const bake::SkinnedMesh& mesh, std::span<const float> vertex_rms);

// Ray traced, model and error beside each other. vertices empty: the whole body.
bake::Picture compare_pose(const bake::SkinnedMesh& mesh, const MeasuredBody& body, std::size_t pose,
                           std::span<const std::uint32_t> vertices);

}  // namespace nook::report
