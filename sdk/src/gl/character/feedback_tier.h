// OpenGL 3.3: shadows at key points on the CPU; vertices by transform feedback on the GPU.
#pragma once

#include "sdk/src/gl/character/scene_buffers.h"

namespace nook::gl {

class FeedbackTier {
 public:
  // Makes a framebuffer and a transform-feedback object too. Throws Failure.
  explicit FeedbackTier(Device& device);

  void update(SceneBuffers& buffers, Scene& scene) const;

 private:
  struct Program {
    Object object;
    GLint first_key_point = -1, key_point_count = -1, self = -1;
  };
  // Where values of vertices come from and go to.
  struct Target {
    const Program* programs;  // for one and two quads of influences
    Buffer* page;
    const Object* page_texture;
    const Buffer* out;
    std::uint32_t channels;
  };
  Program make_program(int quads, bool lit);
  // All wanted places of a chunk, as many as a page holds at a time.
  template <class Kind>
  void draw_chunk(const SceneBuffers& buffers, const Scene& scene, const Chunk& chunk,
                  const Target& target) const;
  // The wanted places of [first, end), whose shadows are in the page in this order.
  void draw_page(const SceneBuffers& buffers, const Chunk& chunk, std::uint32_t first, std::uint32_t end,
                 const Program& program, const Target& target) const;
  // Places [first, end) of a chunk, all evaluated in this update.
  void draw(const Chunk& chunk, std::uint32_t first, std::uint32_t end, const Target& target) const;

  Device& device_;
  Program programs_[2], lit_programs_[2];  // for one and two quads of influences
  Object framebuffer_, renderbuffer_;
  Object feedback_;  // name 0 before OpenGL 4.0
};

}  // namespace nook::gl
