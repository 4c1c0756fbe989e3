// Pictures of a page: light as display values, a body with its error, and a body that the reader turns.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bakers/images/picture.h"
#include "bakers/measure/report/body_findings.h"
#include "bakers/measure/report/html.h"

namespace nook::report {

// Converts values from 0 to 1 with the sRGB curve. Values above 1 become white, values below 0 black.
bake::Colour display(Vec3 linear);

bake::Picture plain_picture(int width, int height, bake::Colour colour);
void set_pixel(bake::Picture& picture, int x, int y, bake::Colour colour);

// AO error at the upper end of the colour scale.
inline constexpr float error_end = 0.25f;

// Returns the direction to a viewer who sees most of the error of the given vertices. The direction is one of
// 24 that are spread over the sphere, except near the poles. Faces that the viewer cannot see do not count.
Vec3 view_of_error(const bake::SkinnedMesh& mesh, const bake::Pose& pose,
                   std::span<const std::uint32_t> vertices, std::span<const float> error);

// Returns eight pictures of the rest pose, 45 degrees apart, from the front towards the body's left.
std::vector<bake::Picture> eight_sides(const bake::SkinnedMesh& mesh, std::span<const float> vertex_rms);

// Shows ray traced, model and error side by side. If `vertices` is empty, shows the whole body.
bake::Picture compare_pose(const bake::SkinnedMesh& mesh, const MeasuredBody& body, std::size_t pose,
                           std::span<const std::uint32_t> vertices);

// A body in several poses, as data for the page's WebGL 2 view.
struct Turnable {
  Html section;  // the view's elements, or a sentence if the body is too large
  Html scripts;
};

struct NamedPose {
  std::size_t pose = 0;
  std::string name;
};

// Takes poses from the first one on, as many as fit into max_bytes of the page.
Turnable turnable_body(const bake::SkinnedMesh& mesh, const MeasuredBody& body,
                       std::span<const NamedPose> poses, std::size_t max_bytes);

}  // namespace nook::report
