// Uploads values that a picture shows from memory. There are values at the vertices of characters, and at the
// points of a patch of the floor.
#pragma once

#include <glad/gl.h>

#include <vector>

#include "bakers/lab/crowd/comparison.h"
#include "bakers/lab/crowd/plain_look.h"

namespace crowd::lab {

namespace measure = nook::lab::crowd;

// A vertex buffer that holds the values of all members of a group, one member after the other.
class VertexBuffer {
 public:
  VertexBuffer(const GladGLContext& gl, const measure::VertexValues& values, std::uint32_t channels)
      : gl_(gl) {
    if (values.empty()) return;
    gl.GenBuffers(1, &buffer_);
    std::vector<float> all;
    for (const std::vector<float>& member : values) {
      sources_.push_back({buffer_, all.size() * sizeof(float), channels * std::uint32_t(sizeof(float))});
      all.insert(all.end(), member.begin(), member.end());
    }
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
    gl.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(all.size() * sizeof(float)), all.data(), GL_STREAM_DRAW);
  }
  ~VertexBuffer() { gl_.DeleteBuffers(1, &buffer_); }
  VertexBuffer(const VertexBuffer&) = delete;
  VertexBuffer& operator=(const VertexBuffer&) = delete;

  // If there are no values, returns a source without a buffer.
  VertexSource source(std::size_t member) const {
    return sources_.empty() ? VertexSource{} : sources_[member];
  }

 private:
  const GladGLContext& gl_;
  GLuint buffer_ = 0;
  std::vector<VertexSource> sources_;
};

// A texture that lies on the floor.
class FloorImage {
 public:
  FloorImage(const GladGLContext& gl, const measure::FloorValues& floor, std::uint32_t channels) : gl_(gl) {
    const measure::FloorPatch& patch = floor.patch;
    // The centres of the texels lie at the points of the patch, so the texture extends half a texel beyond
    // the patch on each side.
    const float texel_m = patch.size_m / float(patch.side - 1);
    floor_.first_m = glm::vec2(patch.low_x_m, patch.low_z_m) - 0.5f * texel_m;
    floor_.extent_m = glm::vec2(patch.size_m + texel_m);
    gl.GenTextures(1, &floor_.texture);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, floor_.texture);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    gl.TexImage2D(GL_TEXTURE_2D, 0, channels == 3 ? GL_RGB32F : GL_R16F, GLsizei(patch.side),
                  GLsizei(patch.side), 0, channels == 3 ? GL_RGB : GL_RED, GL_FLOAT, floor.values.data());
  }
  ~FloorImage() { gl_.DeleteTextures(1, &floor_.texture); }
  FloorImage(const FloorImage&) = delete;
  FloorImage& operator=(const FloorImage&) = delete;

  const FloorTexture& floor() const { return floor_; }

 private:
  const GladGLContext& gl_;
  FloorTexture floor_;
};

}  // namespace crowd::lab
