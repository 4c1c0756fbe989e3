#include "sdk/src/gl/nnao/nnao_frame.h"

#include <cmath>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/nnao/frame_ranges.h"
#include "sdk/src/nnao/host_depth.h"
#include "sdk/src/nnao/projection_check.h"

namespace nook::gl {
namespace {

void check_size(const NnaoFrame& frame, const nook_nnao_desc& pass) {
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

void check_radius(const NnaoFrame& frame) {
  if (frame.radius_kind == NOOK_NNAO_RADIUS_METRES) {
    check_fits("desc.radius", frame.radius, frame.radius > 0, "more than 0 metres");
    return;
  }
  check_fits("desc.radius", frame.radius, frame.radius > 0 && frame.radius <= 1,
             frame.radius_kind == NOOK_NNAO_RADIUS_SCREEN ? "a share of the screen, more than 0 up to 1"
                                                          : "a share of the scene, more than 0 up to 1");
  if (frame.radius_kind == NOOK_NNAO_RADIUS_SCENE)
    check_fits("desc.scene_size", frame.scene_size, frame.scene_size * frame.radius > 0,
               "more than 0 metres");
}

void check_logarithm(const NnaoFrame& frame) {
  if (frame.depth_kind != NOOK_DEPTH_LOGARITHMIC) return;
  check_fits("frame.depth_log_scale", frame.depth_log_scale, frame.depth_log_scale > 0,
             "more than 0 per metre");
  check_fits("frame.depth_log_near", frame.depth_log_near, frame.depth_log_near >= 0, "0 or more metres");
  check_fits("frame.depth_log_far", frame.depth_log_far, frame.depth_log_far > frame.depth_log_near,
             "more metres than depth_log_near");
}

void check_numbers(const NnaoFrame& frame) {
  check_radius(frame);
  nnao::check_shape(frame, nnao::name_in_desc);
  check_fits("frame.sky_depth", frame.sky_depth, frame.sky_depth >= 0, "0 or more metres");
  check_logarithm(frame);
}

void check_kinds(const NnaoFrame& frame) {
  check_known("frame.depth_kind", frame.depth_kind, NOOK_DEPTH_LOGARITHMIC);
  check_known("desc.radius_kind", frame.radius_kind, NOOK_NNAO_RADIUS_SCENE);
  check_known("frame.clip_space", frame.clip_space, NOOK_CLIP_SPACE_ZERO_TO_ONE);
  check_known("frame.gbuffer_ao", frame.gbuffer_ao, NOOK_GBUFFER_AO_EXCLUDE);
  check_known("frame.target", frame.target, NOOK_TARGET_FRAMEBUFFER);
  check_known("frame.blend", frame.blend, NOOK_BLEND_MULTIPLY);
  check_known("debug.show", frame.show, NOOK_NNAO_VIEW_NORMALS);
  if (frame.depth_texture == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.depth_texture is 0; set it to the name of your depth texture");
  if (frame.gbuffer_ao != NOOK_GBUFFER_AO_NONE && frame.gbuffer_ao_texture == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.gbuffer_ao_texture is 0, but frame.gbuffer_ao %d needs the name of a texture",
                  frame.gbuffer_ao);
  if (frame.target == NOOK_TARGET_TEXTURE && frame.target_name == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.target_name is 0; NOOK_TARGET_TEXTURE needs the name of a texture");
  if (frame.target == NOOK_TARGET_OWN &&
      (frame.blend != NOOK_BLEND_WRITE || frame.show == NOOK_NNAO_VIEW_NORMALS))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s %d does not work with NOOK_TARGET_OWN; set frame.target and frame.target_name",
                  frame.blend != NOOK_BLEND_WRITE ? "frame.blend" : "debug.show",
                  frame.blend != NOOK_BLEND_WRITE ? frame.blend : frame.show);
}

void check_normals(const NnaoFrame& frame) {
  if (frame.normal_texture == 0) return;
  check_fits("frame.normal_scale", frame.normal_scale, frame.normal_scale != 0,
             "a finite number other than 0");
  check_fits("frame.normal_bias", frame.normal_bias, true, "a number");
  nnao::check_normal_matrix(frame.normal_matrix);
}

// Checks the fields that are used to average AO over several frames.
void check_motion(const NnaoFrame& frame) {
  check_view(frame.view);
  for (const float scale : frame.motion_vector_scale)
    check_fits("desc.motion_vector_scale", scale, true, "finite numbers");
  if (frame.reset != 0 && frame.reset != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reset is neither on nor off (got %d, need 0 or 1)",
                  frame.reset);
}

void check_matrices(const NnaoFrame& frame, const nook_nnao_desc& pass) {
  check_normals(frame);
  if (pass.max_history_frames) check_motion(frame);
  nnao::check_projection(frame.projection, nnao::DepthKind(frame.depth_kind),
                         nnao::ClipRange(frame.clip_space));
}

void check_textures_changed(const NnaoFrame& frame) {
  if (frame.textures_changed != 0 && frame.textures_changed != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.textures_changed is neither on nor off (got %d, need 0 or 1)",
                  frame.textures_changed);
}

}  // namespace

void check_view(const float (&m)[16]) {
  bool finite = true;
  for (const float element : m) finite = finite && std::isfinite(element);
  const Vec3 x{m[0], m[1], m[2]}, y{m[4], m[5], m[6]}, z{m[8], m[9], m[10]};
  const auto near = [](float value, float need) { return std::abs(value - need) <= 0.01f; };
  // The tolerance of 1 % is the same as for the matrices of poses.
  if (!finite || !near(dot(x, x), 1) || !near(dot(y, y), 1) || !near(dot(z, z), 1) || !near(dot(x, y), 0) ||
      !near(dot(y, z), 0) || !near(dot(z, x), 0) || !near(m[3], 0) || !near(m[7], 0) || !near(m[11], 0) ||
      !near(m[15], 1))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.view is not a rotation with a translation (its first axis is %g %g %g; need a rigid "
                  "matrix from world to view space, column-major)",
                  double(m[0]), double(m[1]), double(m[2]));
}

void check_frame(const NnaoFrame& frame, const nook_nnao_desc& pass) {
  check_size(frame, pass);
  check_kinds(frame);
  check_numbers(frame);
  check_textures_changed(frame);
  if (pass.views == 0) {
    check_matrices(frame, pass);
    return;
  }
  if (frame.target == NOOK_TARGET_FRAMEBUFFER)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.target %d cannot be combined with desc.views %d; use NOOK_TARGET_TEXTURE with a texture array",
        frame.target, pass.views);
  for (int layer = 0; layer < pass.views; ++layer) {
    try {
      check_matrices(layer_frame(frame, layer), pass);
    } catch (const Failure& failure) {
      throw Failure(failure.code(), "view %d: %s", layer, failure.what());
    }
  }
}

}  // namespace nook::gl
