// What the screen-space pass and the world pass share. Both draw triangles over a host's images, and write AO
// to the host's target or to their own texture.
#pragma once

#include <nook/nook_nnao.h>

#include <optional>
#include <span>

#include "sdk/src/gl/nnao/checked_images.h"
#include "sdk/src/gl/nnao/host_images.h"
#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/gl/nnao/render_texture.h"
#include "sdk/src/gl/nnao/surface_watch.h"

namespace nook::gl {

// Returns true if the frame writes every texel of a target that is not a framebuffer of the host. The old
// contents are not needed then.
bool replaces_target(const NnaoFrame& frame, const nook_nnao_desc& pass);

// A program that reads the constants of a frame.
struct ScreenStage {
  Object program;
  GLint frame = -1;
};

struct SamplerUnit {
  const char* name;
  GLint unit;
};

// Every call may change any of the state that the users of screen_creation_users touch; the caller must hold
// a StateGuard.
class ScreenPass {
 public:
  GLuint ao_texture() const { return own_.texture(); }

 protected:
  // desc: the screen-space pass's, or the values that another pass uses for the frame's constants. Its
  // network and next are not kept. Makes no OpenGL call.
  ScreenPass(Device& device, const NnaoSettings& desc);

  // Throws Failure if the pass is larger than this OpenGL's textures.
  void check_size() const;
  // Makes the objects of all draws. own_ must exist already; it starts with this colour.
  void make_objects(const GLfloat (&open)[4]);
  // Finds the frame's constants in a program and sets its samplers; the program may lack some of them.
  void make_stage(ScreenStage& stage, Object program, std::span<const SamplerUnit> samplers) const;

  // Returns what is known about the images of a frame. Throws Failure before anything is drawn unless they
  // are sound.
  ImageFacts check(const HostImages& images, bool changed);
  // Makes the stage that draws a pixel for each surface; only with nook_gl_desc.debug.
  void make_watch(ScreenStage stage);
  // If that stage exists, counts the surfaces of the frame. bind_depth(frame) binds the depth of a layer.
  // Draws into the pass's own texture, which the frame overwrites.
  template <class BindDepth>
  void watch_surfaces(const NnaoFrame& frame, const BindDepth& bind_depth) {
    if (!watch_ || !watch_->begin(device_, frame)) return;
    for (int layer = 0; layer < drawn_layers(desc_); ++layer) {
      const NnaoFrame one = desc_.views > 0 ? layer_frame(frame, layer) : frame;
      bind_depth(one);
      set_frame(watch_stage_, frame_constants(one, desc_, 0, layer));
      draw(own_.framebuffer(), viewport_of(one), false);
    }
    watch_->end(device_);
  }
  // Sets the state that all draws of a frame share.
  void begin_frame() const;
  void bind_texture(GLuint unit, GLuint texture) const;
  // Makes the program current.
  void set_frame(const ScreenStage& stage, const FrameConstants& constants) const;
  // Draws the current program. discards: nothing outside the viewport is needed afterwards.
  void draw(GLuint framebuffer, const Viewport& viewport, bool discards) const;
  // Runs the current compute shader, which writes texels of the target as an image of `format`, in groups of
  // group_size x group_size.
  void dispatch(const RenderTexture& target, GLenum format, int width, int height, int group_size) const;
  // Draws the current program into the frame's target. layer: of the target's texture array, for passes with
  // views.
  void draw_output(const NnaoFrame& frame, int layer) const;

  Device& device_;
  NnaoSettings desc_;
  RenderTexture own_;
  Object sampler_, vertex_array_, target_framebuffer_;

 private:
  CheckedImages checked_;
  std::optional<SurfaceWatch> watch_;
  ScreenStage watch_stage_;
  bool coarse_depth_told_ = false;
};

}  // namespace nook::gl
