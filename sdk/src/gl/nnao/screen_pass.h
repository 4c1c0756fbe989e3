// The base class of the screen-space pass and the world pass. Both read a host's images, draw full-screen
// triangles, and write AO to the host's target or to their own texture.
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

// Returns true if the frame overwrites every texel of a target that is not a framebuffer of the host. Then
// the old contents of the target are not needed.
bool replaces_target(const NnaoFrame& frame, const nook_nnao_desc& pass);

// A program with the location of the frame's constants.
struct ScreenStage {
  Object program;
  GLint frame = -1;
};

struct SamplerUnit {
  const char* name;
  GLint unit;
};

// Every call may change any state of the users that screen_creation_users returns, so the caller must hold a
// StateGuard.
class ScreenPass {
 public:
  GLuint ao_texture() const { return own_.texture(); }

 protected:
  // `desc` is the descriptor of the screen-space pass. The world pass only sets the fields on which the
  // frame's constants depend. The pointers `network` and `next` of `desc` are not kept. Makes no OpenGL
  // calls.
  ScreenPass(Device& device, const NnaoSettings& desc);

  // Throws Failure if the pass is larger than the maximum texture size of this OpenGL context.
  void check_size() const;
  // Creates the objects that all draws need, and clears own_, which must already exist, to the colour `open`.
  void make_objects(const GLfloat (&open)[4]);
  // Finds the location of the frame's constants in a program, and assigns texture units to its samplers. The
  // program need not have all of these samplers.
  void make_stage(ScreenStage& stage, Object program, std::span<const SamplerUnit> samplers) const;

  // Checks the images of a frame, and returns facts about them. If an image is not suitable, throws Failure
  // before anything is drawn.
  ImageFacts check(const HostImages& images, bool changed);
  // Sets the stage that draws only the pixels that SurfaceWatch asks for. It is only used if
  // nook_gl_desc.debug is set.
  void make_watch(ScreenStage stage, bool has_radius);
  // If the stage of make_watch exists, checks whether the frame can show AO. bind_images(frame) must bind the
  // depth and the G-buffer AO of a layer. Draws into the pass's own texture, which the frame overwrites
  // later.
  template <class BindImages>
  void watch_surfaces(const NnaoFrame& frame, const BindImages& bind_images) {
    if (!watch_ || !watch_->begin_frame(device_, frame)) return;
    for (int question = 0; question < SurfaceWatch::questions; ++question) {
      if (!watch_->begin(device_, question)) continue;
      for (int layer = 0; layer < drawn_layers(desc_); ++layer) {
        const NnaoFrame one = desc_.views > 0 ? layer_frame(frame, layer) : frame;
        bind_images(one);
        draw_watch(one, layer, question);
      }
      watch_->end(device_);
    }
  }
  // Sets the OpenGL state that is common to all draws of a frame.
  void begin_frame() const;
  void bind_texture(GLuint unit, GLuint texture) const;
  // Makes the program of a stage current, and sets its frame constants.
  void set_frame(const ScreenStage& stage, const FrameConstants& constants) const;
  // Draws with the current program. Pass true for `discards` if the old contents of the framebuffer are not
  // needed, also outside the viewport.
  void draw(GLuint framebuffer, const Viewport& viewport, bool discards) const;
  // Dispatches the current compute shader, with groups of group_size x group_size threads. The shader writes
  // the target as an image of the format `format`.
  void dispatch(const RenderTexture& target, GLenum format, int width, int height, int group_size) const;
  // Draws with the current program into the frame's target. `layer` is the layer of the target's texture
  // array, used only for passes with views.
  void draw_output(const NnaoFrame& frame, int layer) const;

  Device& device_;
  NnaoSettings desc_;
  RenderTexture own_;
  Object sampler_, vertex_array_, target_framebuffer_;

 private:
  void draw_watch(const NnaoFrame& frame, int layer, int question) const;

  CheckedImages checked_;
  std::optional<SurfaceWatch> watch_;
  ScreenStage watch_stage_;
  GLint watch_question_ = -1;
  bool coarse_depth_told_ = false;
};

}  // namespace nook::gl
