// Makes the pictures of a page: radiance as display values, a body with its error, and a body that the reader
// can rotate.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bakers/images/picture.h"
#include "bakers/measure/report/body_findings.h"
#include "bakers/measure/report/html.h"

namespace nook::report {

// Applies the sRGB curve to values from 0 to 1. Larger values become white, and negative values become black.
bake::Colour display(Vec3 linear);

bake::Picture plain_picture(int width, int height, bake::Colour colour);
void set_pixel(bake::Picture& picture, int x, int y, bake::Colour colour);

// AO error at the upper end of the colour scale.
inline constexpr float error_end = 0.25f;

// Tests 24 directions that are spread over the sphere, except near the poles. Returns the direction from
// which a viewer sees most of the error of the given vertices. Faces that the viewer cannot see do not count.
Vec3 view_of_error(const bake::SkinnedMesh& mesh, const bake::Pose& pose,
                   std::span<const std::uint32_t> vertices, std::span<const float> error);

// Returns eight pictures of the rest pose, 45 degrees apart, from the front towards the body's left.
std::vector<bake::Picture> eight_sides(const bake::SkinnedMesh& mesh, std::span<const float> vertex_rms);

// Shows the ray-traced AO, the model's AO and the error side by side. Shows the region around `vertices`, or
// the whole body if `vertices` is empty.
bake::Picture compare_pose(const bake::SkinnedMesh& mesh, const MeasuredBody& body, std::size_t pose,
                           std::span<const std::uint32_t> vertices);

// A body in several poses that the reader can rotate, as data for the page's WebGL 2 view.
struct Turnable {
  Html section;  // the view's elements, or a sentence if the body is too large
  Html scripts;
};

struct NamedPose {
  std::size_t pose = 0;
  std::string name;
};

// Uses the first poses, as many as fit into max_bytes of the page.
Turnable turnable_body(const bake::SkinnedMesh& mesh, const MeasuredBody& body,
                       std::span<const NamedPose> poses, std::size_t max_bytes);

}  // namespace nook::report
