// OpenGL 3.3: shadows at key points on the CPU; vertices by transform feedback on the GPU.
#pragma once

#include "gl/character/scene_buffers.h"

namespace nook::gl {

class FeedbackTier {
 public:
  // Makes a framebuffer and a transform-feedback object too. Throws Failure.
  explicit FeedbackTier(Device& device);

  void update(SceneBuffers& buffers, Scene& scene) const;

 private:
  struct Program {
    Object object;
    GLint first_texel = -1, key_point_count = -1, self = -1;
  };
  // The wanted places of [first, end), whose shadows are in the page in this order.
  void draw_page(const SceneBuffers& buffers, const Chunk& chunk, std::uint32_t first, std::uint32_t end,
                 bool self) const;
  // Places [first, end) of a chunk, all evaluated in this update, whose shadows begin at `texel` of the page.
  void draw(const Chunk& chunk, std::uint32_t first, std::uint32_t end, std::uint32_t texel, bool self) const;

  Device& device_;
  Program programs_[2];  // for one and two quads of influences
  Object framebuffer_, renderbuffer_;
  Object feedback_;  // name 0 before OpenGL 4.0
};

}  // namespace nook::gl
