// A host that draws the stages of nook_stages.h in plain OpenGL, as one with another graphics interface
// would.
#pragma once

#include <nook/experimental/nook_stages.h>

#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "platform/program.h"
#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/nnao_images.h"

namespace nook::test {

template <class Info>
Info sized() {
  Info info{};
  info.struct_size = sizeof info;
  return info;
}

// A texture whose filter needs no mipmaps: the stages have no samplers of their own here.
inline GLuint nearest(const GladGLContext& gl, GLenum target, GLuint name) {
  gl.BindTexture(target, name);
  gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.BindTexture(target, 0);
  return name;
}

// A host's renderer: pipelines, images and buffers as another graphics interface has them.
class StageRenderer {
 public:
  // edited: the text that is compiled in place of a stage's; null: its own.
  using Edit = std::function<std::string(const std::string& text, const std::string& stage)>;
  StageRenderer(const GladGLContext& gl, nook_nnao_stages stages, const Edit& edited = nullptr)
      : gl_(gl), stages_(stages), textures_(gl) {
    info_ = sized<nook_nnao_stages_info>();
    NOOK_OK_OR_FAIL(nook_nnao_stages_describe(stages, &info_));
    for (std::uint32_t i = 0; i < info_.stage_count; ++i) {
      auto stage = sized<nook_nnao_stage_info>();
      NOOK_OK_OR_FAIL(nook_nnao_stages_describe_stage(stages, i, &stage));
      stages_info_.push_back(stage);
      std::string vertex = info_.vertex_shader, fragment = stage.fragment_shader;
      if (edited) vertex = edited(vertex, "vertex"), fragment = edited(fragment, stage.name);
      pipelines_.push_back(
          std::make_unique<platform::Program>(gl, std::initializer_list<const char*>{vertex.c_str()},
                                              std::initializer_list<const char*>{fragment.c_str()}));
    }
    for (nook_nnao_image image = NOOK_NNAO_IMAGE_DEPTH; image < NOOK_NNAO_IMAGE_COUNT; ++image) {
      auto info = sized<nook_nnao_image_info>();
      NOOK_OK_OR_FAIL(nook_nnao_stages_describe_image(stages, image, &info));
      images_[image] = info.format == NOOK_NNAO_FORMAT_NONE ? 0 : make_image(info);
    }
    gl.GenBuffers(2, buffers_);
    gl.BindBuffer(GL_UNIFORM_BUFFER, buffers_[1]);
    gl.BufferData(GL_UNIFORM_BUFFER, info_.network_bytes, info_.network, GL_STATIC_DRAW);
    gl.BindBuffer(GL_UNIFORM_BUFFER, 0);
    gl.GenFramebuffers(1, &framebuffer_);
    gl.GenVertexArrays(1, &vertex_array_);
  }
  ~StageRenderer() {
    gl_.DeleteBuffers(2, buffers_);
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteVertexArrays(1, &vertex_array_);
  }

  GLuint target() { return images_[NOOK_NNAO_IMAGE_TARGET]; }

  // host: the targets and names of the host's images.
  void draw(const ScreenFrame& frame, const ScreenFrame* earlier, std::uint32_t number, std::uint32_t layer,
            std::map<nook_nnao_image, std::pair<GLenum, GLuint>> host) {
    auto values = sized<nook_nnao_frame_values>();
    NOOK_OK_OR_FAIL(nook_nnao_stages_frame(stages_, &frame, &frame, earlier, number, layer, &values));
    gl_.BindBuffer(GL_UNIFORM_BUFFER, buffers_[0]);
    gl_.BufferData(GL_UNIFORM_BUFFER, sizeof values.constants, values.constants, GL_STREAM_DRAW);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, buffers_[0]);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, 1, buffers_[1]);
    gl_.BindVertexArray(vertex_array_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    for (std::uint32_t i = 0; i < info_.stage_count; ++i) {
      if (!(values.drawn_stages >> i & 1)) continue;
      const nook_nnao_stage_info& stage = stages_info_[i];
      for (std::uint32_t input = 0; input < stage.input_count; ++input) {
        const nook_nnao_image image = stage.inputs[input];
        gl_.ActiveTexture(GL_TEXTURE0 + 2 + input);
        if (image < NOOK_NNAO_IMAGE_DEPTH)
          gl_.BindTexture(host.at(image).first, host.at(image).second);
        else
          gl_.BindTexture(GL_TEXTURE_2D, images_[image]);
      }
      gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, images_[stage.output], 0);
      if (stage.draws_viewport)
        gl_.Viewport(values.viewport[0], values.viewport[1], values.viewport[2], values.viewport[3]);
      else
        gl_.Viewport(0, 0, values.surface_width, values.surface_height);
      pipelines_[i]->use();
      gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    std::swap(images_[NOOK_NNAO_IMAGE_DEPTH], images_[NOOK_NNAO_IMAGE_HISTORY_DEPTH]);
    std::swap(images_[NOOK_NNAO_IMAGE_ACCUMULATED_AO], images_[NOOK_NNAO_IMAGE_HISTORY_AO]);
    if (!images_[NOOK_NNAO_IMAGE_DEPTH])  // not of a pass with means: the image stays
      std::swap(images_[NOOK_NNAO_IMAGE_DEPTH], images_[NOOK_NNAO_IMAGE_HISTORY_DEPTH]);
    for (GLenum unit = 0; unit < 8; ++unit) {
      gl_.ActiveTexture(GL_TEXTURE0 + unit);
      for (const GLenum target :
           {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_2D_MULTISAMPLE_ARRAY})
        gl_.BindTexture(target, 0);
    }
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.UseProgram(0);
    gl_.BindVertexArray(0);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    for (const GLuint binding : {0u, 1u}) gl_.BindBufferBase(GL_UNIFORM_BUFFER, binding, 0);
  }

 private:
  GLuint make_image(const nook_nnao_image_info& info) {
    GLuint name = 0;
    switch (info.format) {
      case NOOK_NNAO_FORMAT_R8_UNORM:
        name = textures_.make(GL_R8, GL_RED, GL_UNSIGNED_BYTE, info.width, info.height, nullptr);
        break;
      case NOOK_NNAO_FORMAT_R8G8_UNORM:
        name = textures_.make(GL_RG8, GL_RG, GL_UNSIGNED_BYTE, info.width, info.height, nullptr);
        break;
      case NOOK_NNAO_FORMAT_R32_UINT:
        name = textures_.make(GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, info.width, info.height, nullptr);
        break;
      case NOOK_NNAO_FORMAT_R32G32_UINT:
        name = textures_.make(GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, info.width, info.height, nullptr);
        break;
      default:
        name = textures_.make(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, info.width, info.height, nullptr);
    }
    set_nearest(GL_TEXTURE_2D, name);
    return name;
  }
  void set_nearest(GLenum target, GLuint name) {
    gl_.BindTexture(target, name);
    gl_.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.BindTexture(target, 0);
  }

  const GladGLContext& gl_;
  nook_nnao_stages stages_;
  nook_nnao_stages_info info_;
  std::vector<nook_nnao_stage_info> stages_info_;
  std::vector<std::unique_ptr<platform::Program>> pipelines_;
  Textures textures_;
  std::map<nook_nnao_image, GLuint> images_;
  GLuint buffers_[2] = {}, framebuffer_ = 0, vertex_array_ = 0;
};

}  // namespace nook::test
