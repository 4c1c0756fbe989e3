#include "sdk/src/gl/nnao/frame_check.h"

#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/frame_constants.h"
#include "sdk/src/nnao/host_depth.h"

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

void check_radius(const nook_nnao_frame_desc& frame) {
  if (frame.radius_kind == NOOK_NNAO_RADIUS_METRES) {
    check_range("radius", frame.radius, frame.radius > 0, "more than 0 metres");
    return;
  }
  check_range("radius", frame.radius, frame.radius > 0 && frame.radius <= 1,
              frame.radius_kind == NOOK_NNAO_RADIUS_SCREEN ? "a share of the screen, more than 0 up to 1"
                                                           : "a share of the scene, more than 0 up to 1");
  if (frame.radius_kind == NOOK_NNAO_RADIUS_SCENE)
    check_range("scene_size", frame.scene_size, frame.scene_size * frame.radius > 0, "more than 0 metres");
}

void check_logarithm(const nook_nnao_frame_desc& frame) {
  if (frame.depth_kind != NOOK_NNAO_DEPTH_LOGARITHMIC) return;
  check_range("depth_log_scale", frame.depth_log_scale, frame.depth_log_scale > 0, "more than 0 per metre");
  check_range("depth_log_near", frame.depth_log_near, frame.depth_log_near >= 0, "0 or more metres");
  check_range("depth_log_far", frame.depth_log_far, frame.depth_log_far > frame.depth_log_near,
              "more metres than depth_log_near");
}

void check_numbers(const nook_nnao_frame_desc& frame) {
  check_radius(frame);
  check_range("max_radius_px", frame.max_radius_px, frame.max_radius_px == 0 || frame.max_radius_px >= 1,
              "at least 1 pixel, or 0 for the default");
  check_range("intensity", frame.intensity, frame.intensity >= 0 && frame.intensity <= 16, "0 to 16");
  check_range("power", frame.power, frame.power > 0 && frame.power <= 16, "more than 0, up to 16");
  check_range("sky_depth", frame.sky_depth, frame.sky_depth >= 0, "0 or more metres");
  check_logarithm(frame);
}

void check_kinds(const nook_nnao_frame_desc& frame) {
  check_kind("depth_kind", frame.depth_kind, NOOK_NNAO_DEPTH_LOGARITHMIC);
  check_kind("radius_kind", frame.radius_kind, NOOK_NNAO_RADIUS_SCENE);
  check_kind("clip", frame.clip, NOOK_NNAO_CLIP_ZERO_TO_ONE);
  check_kind("layer", frame.layer, NOOK_NNAO_LAYER_APART);
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
  nnao::check_normal_matrix(frame.normal_matrix);
}

// The numbers of a pass over several frames.
void check_motion(const nook_nnao_frame_desc& frame) {
  for (const float number : frame.earlier_from_view)
    check_range("earlier_from_view", number, true, "twelve finite numbers");
  for (const float scale : frame.motion_scale) check_range("motion_scale", scale, true, "finite numbers");
  if (frame.reset != 0 && frame.reset != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "frame.reset is neither on nor off (got %d, need 0 or 1)",
                  frame.reset);
}

void check_matrices(const nook_nnao_frame_desc& frame, const nook_nnao_desc& pass) {
  check_normals(frame);
  if (pass.temporal_frames) check_motion(frame);
  nnao::check_projection(frame.projection, nnao::DepthKind(frame.depth_kind));
}

}  // namespace

void check_frame(const nook_nnao_frame_desc& frame, const nook_nnao_desc& pass) {
  check_size(frame, pass);
  check_kinds(frame);
  check_numbers(frame);
  if (pass.layers == 0) {
    check_matrices(frame, pass);
    return;
  }
  if (frame.target == NOOK_NNAO_TARGET_FRAMEBUFFER)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.target %d does not go with desc.layers %d; give a texture array by "
                  "NOOK_NNAO_TARGET_TEXTURE",
                  frame.target, pass.layers);
  for (int layer = 0; layer < pass.layers; ++layer) {
    try {
      check_matrices(layer_frame(frame, layer), pass);
    } catch (const Failure& failure) {
      throw Failure(failure.code(), "layer %d: %s", layer, failure.what());
    }
  }
}

}  // namespace nook::gl
