#include "sdk/src/gl/nnao/surface_watch.h"

#include <cstdint>

namespace nook::gl {

SurfaceWatch::SurfaceWatch(Device& device, bool has_radius)
    : has_radius_(has_radius),
      target_(device.gl.profile == Profile::desktop ? GL_SAMPLES_PASSED : GL_ANY_SAMPLES_PASSED) {
  for (Query& query : queries_) query.object = Object::make(device, Object::Kind::query);
}

bool SurfaceWatch::asks(int question) const {
  switch (question) {
    case NOOK_WATCH_UNMASKED:
      return frame_.show == NOOK_NNAO_VIEW_AO && frame_.gbuffer_ao >= NOOK_GBUFFER_AO_REPLACE;
    case NOOK_WATCH_FAR_ENOUGH:
    case NOOK_WATCH_NEAR_ENOUGH:
      return has_radius_ && frame_.radius_kind != NOOK_NNAO_RADIUS_SCREEN;
    case NOOK_WATCH_REVERSED:
      // OpenGL ES only tells whether the radius would fit any pixel, which may be an edge.
      return has_radius_ && frame_.radius_kind != NOOK_NNAO_RADIUS_SCREEN &&
             frame_.depth_kind == NOOK_DEPTH_HARDWARE && target_ == GL_SAMPLES_PASSED;
    default:
      return true;
  }
}

bool SurfaceWatch::begin_frame(const Device& device, const NnaoFrame& frame) {
  if (!read(device)) return false;
  if (is_watching_) judge(device);
  forget_changed(frame);
  is_watching_ = true;
  frame_ = frame;
  return true;
}

bool SurfaceWatch::begin(const Device& device, int question) {
  if (!asks(question)) return false;
  Query& query = queries_[std::size_t(question)];
  device.gl.BeginQuery(target_, query.object.name());
  query.pending = true;
  return true;
}

void SurfaceWatch::end(const Device& device) {
  device.gl.EndQuery(target_);
}

// Returns false if a result is not available yet.
bool SurfaceWatch::read(const Device& device) {
  const Functions& gl = device.gl;
  for (Query& query : queries_) {
    if (!query.pending) continue;
    GLuint there = GL_FALSE;
    gl.GetQueryObjectuiv(query.object.name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (!there) return false;
    gl.GetQueryObjectuiv(query.object.name(), GL_QUERY_RESULT, &query.pixels);
    query.pending = false;
  }
  return true;
}

// Forgets that a setting was right in an earlier frame if the next frame has another value.
void SurfaceWatch::forget_changed(const NnaoFrame& next) {
  if (next.gbuffer_ao != frame_.gbuffer_ao) was_right_[NOOK_WATCH_UNMASKED] = false;
  if (next.radius != frame_.radius || next.radius_kind != frame_.radius_kind ||
      next.scene_size != frame_.scene_size)
    was_right_[NOOK_WATCH_FAR_ENOUGH] = was_right_[NOOK_WATCH_NEAR_ENOUGH] = false;
}

void SurfaceWatch::judge(const Device& device) {
  const GLuint seen = queries_[NOOK_WATCH_SURFACE].pixels;
  for (int question = 0; question < questions; ++question) {
    // Without a surface, the other questions have no answer.
    if (!asks(question) || (question != NOOK_WATCH_SURFACE && seen == 0)) continue;
    if (question == NOOK_WATCH_REVERSED) continue;  // it only explains a radius that does not fit
    // A radius that fits at least 1 of 20 pixels is probably intended. Queries of OpenGL ES only return
    // whether any pixel was drawn, so there the radius is wrong only if it fits no pixel.
    const bool is_radius = question == NOOK_WATCH_FAR_ENOUGH || question == NOOK_WATCH_NEAR_ENOUGH;
    const std::uint64_t pixels = queries_[std::size_t(question)].pixels;
    const bool is_wrong = is_radius ? 20 * pixels < seen : pixels == 0;
    bool &was_wrong = was_wrong_[std::size_t(question)], &was_right = was_right_[std::size_t(question)];
    if (is_wrong && !was_wrong && !was_right) {
      // Reversed depth is close to the near plane, where every radius is large.
      if (question == NOOK_WATCH_FAR_ENOUGH && looks_reversed(seen))
        report_reversed(device);
      else
        report(device, question);
    }
    was_wrong = is_wrong;
    // A missing surface is reported even if earlier frames had one: the host may have stopped drawing depth.
    if (question != NOOK_WATCH_SURFACE) was_right |= !is_wrong;
  }
}

// True if the radius would fit most surfaces with reversed depth.
bool SurfaceWatch::looks_reversed(std::uint64_t seen) const {
  return asks(NOOK_WATCH_REVERSED) && 2 * std::uint64_t{queries_[NOOK_WATCH_REVERSED].pixels} >= seen;
}

void SurfaceWatch::report_reversed(const Device& device) const {
  device.context.log(
      NOOK_LOG_WARNING,
      "nook_gl: the depth of an earlier frame looks reversed: at almost all surfaces of frame.depth_texture "
      "%u, the radius %g fits only if depth is 1 minus the stored value; draw depth with glDepthRange(0, 1). "
      "If your projection reverses depth, set frame.projection to that projection, as it drew the depth, and "
      "frame.clip_space to its range",
      frame_.depth_texture, double(frame_.radius));
}

void SurfaceWatch::report(const Device& device, int question) const {
  const Context& context = device.context;
  const double radius =
      double(frame_.radius) * (frame_.radius_kind == NOOK_NNAO_RADIUS_SCENE ? double(frame_.scene_size) : 1);
  switch (question) {
    case NOOK_WATCH_UNMASKED:
      context.log(NOOK_LOG_WARNING,
                  "nook_gl: an earlier frame got no AO from the pass, because the mask covers every surface: "
                  "the green channel of frame.gbuffer_ao_texture %u is 1 at every surface (with "
                  "frame.gbuffer_ao %d); clear green to 0 where the pass should darken, such as on floors",
                  frame_.gbuffer_ao_texture, frame_.gbuffer_ao);
      return;
    case NOOK_WATCH_FAR_ENOUGH:
      context.log(
          NOOK_LOG_WARNING,
          "nook_gl: at almost all surfaces of an earlier frame, the radius is larger than the picture's "
          "height (got %g units of view space); give the radius in the unit of frame.projection, such as 0.5 "
          "in metres, and check that the depth was drawn with the projection's near and far plane",
          radius);
      return;
    case NOOK_WATCH_NEAR_ENOUGH:
      context.log(
          NOOK_LOG_WARNING,
          "nook_gl: at almost all surfaces of an earlier frame, the radius is smaller than two pixels, so "
          "that AO is hardly visible (got %g units of view space); give the radius in the unit of "
          "frame.projection, such as 50 in centimetres, and check that the depth was drawn with the "
          "projection's near and far plane",
          radius);
      return;
    default:
      context.log(
          NOOK_LOG_WARNING,
          "nook_gl: an earlier frame showed no surface: all of frame.depth_texture %u is sky or beyond "
          "the far plane (with frame.depth_kind %d and frame.clip_space %d); check that depth was "
          "drawn before the call. Also check frame.depth_kind, reversed depth, frame.clip_space and "
          "frame.sky_depth",
          frame_.depth_texture, frame_.depth_kind, frame_.clip_space);
  }
}

}  // namespace nook::gl
