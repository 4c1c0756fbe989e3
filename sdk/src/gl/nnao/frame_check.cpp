#include "sdk/src/gl/nnao/frame_check.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/frame_constants.h"

namespace nook::gl {
namespace {

void check_range(const char* field, float value, bool fits, const char* need) {
  if (!std::isfinite(value) || !fits)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "frame.%s is out of range (got %g, need %s)", field,
                  static_cast<double>(value), need);
}

void check_kind(const char* field, int value, int last) {
  if (value < 0 || value > last)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "frame.%s is unknown (got %d, need 0 to %d)", field, value,
                  last);
}

void check_size(const nook_nnao_frame_desc& frame, const nook_nnao_desc& pass) {
  if (frame.width < 1 || frame.height < 1 || frame.width > pass.max_width || frame.height > pass.max_height)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.width and frame.height are out of range (got %d x %d, need 1 x 1 to the pass's maximum "
        "of %d x %d)",
        frame.width, frame.height, pass.max_width, pass.max_height);
  const Viewport v = viewport_of(frame);
  if (v.x < 0 || v.y < 0 || v.width < 1 || v.height < 1 || v.width > frame.width - v.x ||
      v.height > frame.height - v.y)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.viewport does not lie in the frame (got x %d, y %d, %d x %d, need a part of %d x %d)", v.x,
        v.y, v.width, v.height, frame.width, frame.height);
}

void check_numbers(const nook_nnao_frame_desc& frame) {
  check_range("radius", frame.radius, frame.radius > 0, "more than 0 metres");
  check_range("max_radius_px", frame.max_radius_px, frame.max_radius_px == 0 || frame.max_radius_px >= 1,
              "at least 1 pixel, or 0 for the default");
  check_range("intensity", frame.intensity, frame.intensity >= 0 && frame.intensity <= 16, "0 to 16");
  check_range("power", frame.power, frame.power > 0 && frame.power <= 16, "more than 0, up to 16");
  check_range("sky_depth", frame.sky_depth, frame.sky_depth >= 0, "0 or more metres");
}

void check_kinds(const nook_nnao_frame_desc& frame) {
  check_kind("depth_kind", frame.depth_kind, NOOK_NNAO_DEPTH_LINEAR);
  check_kind("clip", frame.clip, NOOK_NNAO_CLIP_ZERO_TO_ONE);
  check_kind("layer", frame.layer, NOOK_NNAO_LAYER_REPLACE);
  check_kind("target", frame.target, NOOK_NNAO_TARGET_FRAMEBUFFER);
  check_kind("blend", frame.blend, NOOK_NNAO_MULTIPLY);
  check_kind("view", frame.view, NOOK_NNAO_VIEW_NORMALS);
  if (frame.depth_texture == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.depth_texture is 0; give the name of a texture with depth");
  if (frame.layer != NOOK_NNAO_LAYER_NONE && frame.layer_texture == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.layer_texture is 0; frame.layer %d needs the name of a texture", frame.layer);
  if (frame.target == NOOK_NNAO_TARGET_TEXTURE && frame.target_name == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.target_name is 0; NOOK_NNAO_TARGET_TEXTURE needs the name of a texture");
  if (frame.target == NOOK_NNAO_TARGET_OWN &&
      (frame.blend != NOOK_NNAO_WRITE || frame.view == NOOK_NNAO_VIEW_NORMALS))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.%s %d needs a target of the host; set frame.target and frame.target_name",
                  frame.blend != NOOK_NNAO_WRITE ? "blend" : "view",
                  frame.blend != NOOK_NNAO_WRITE ? frame.blend : frame.view);
}

void check_normals(const nook_nnao_frame_desc& frame) {
  if (frame.normal_texture == 0) return;
  check_range("normal_scale", frame.normal_scale, frame.normal_scale != 0, "a number other than 0");
  check_range("normal_bias", frame.normal_bias, true, "a number");
  const float* m = frame.normal_matrix;
  const double determinant = double(m[0]) * (double(m[4]) * m[8] - double(m[7]) * m[5]) -
                             double(m[3]) * (double(m[1]) * m[8] - double(m[7]) * m[2]) +
                             double(m[6]) * (double(m[1]) * m[5] - double(m[4]) * m[2]);
  if (!std::isfinite(determinant) || std::abs(determinant) < 1e-12)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.normal_matrix cannot be inverted (got the determinant %g, need a rotation to view space)",
        determinant);
}

void check_projection(const nook_nnao_frame_desc& frame) {
  const float* m = frame.projection;
  float largest = 0;
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i]))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "frame.projection[%d] is not finite (got %g, need a projection matrix)", i,
                    static_cast<double>(m[i]));
    largest = std::max(largest, std::abs(m[i]));
  }
  const auto zero = [&](int i) { return std::abs(m[i]) <= 1e-6f * largest; };
  const bool hardware = frame.depth_kind == NOOK_NNAO_DEPTH_HARDWARE;
  const bool perspective = !zero(11);
  if (zero(0) || zero(5) || (perspective ? m[11] > 0 : !(m[15] > 0)))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is no projection of a camera that looks along -z, or singular (got [0] "
                  "%g, [5] %g, [11] "
                  "%g, [15] %g; need [0] and [5] other than 0, and [11] below 0 or [15] above 0)",
                  double(m[0]), double(m[5]), double(m[11]), double(m[15]));
  // Clip x depends on x and z, clip y on y and z, and depth on z alone: there is no roll, no shear and no
  // oblique clip plane.
  for (const int i : {1, 3, 4, 7, perspective ? 12 : 8, perspective ? 13 : 9, perspective ? 15 : 11})
    if (!zero(i))
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "frame.projection[%d] is %g, need 0; give the projection alone, not multiplied by a view matrix", i,
          double(m[i]));
  if (!hardware) return;
  for (const int i : {2, 6})
    if (!zero(i))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "frame.projection[%d] is %g, need 0; with an oblique clip plane give linear depth", i,
                    double(m[i]));
  if (m[perspective ? 14 : 10] == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is singular: depth does not depend on the distance (got [%d] 0)",
                  perspective ? 14 : 10);
}

}  // namespace

void check_frame(const nook_nnao_frame_desc& frame, const nook_nnao_desc& pass) {
  check_size(frame, pass);
  check_kinds(frame);
  check_numbers(frame);
  check_normals(frame);
  check_projection(frame);
}

}  // namespace nook::gl
