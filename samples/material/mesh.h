// A shape in OpenGL buffers.
#pragma once

#include <glad/gl.h>

#include "samples/material/material_shapes.h"

namespace material {

class Mesh {
 public:
  Mesh(const GladGLContext& gl, const Shape& shape);
  Mesh(Mesh&& other) noexcept;
  ~Mesh();
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;

  // The attributes 0 to 3 are position, normal, tangent and uv.
  void draw() const;

 private:
  const GladGLContext& gl_;
  GLuint vertex_array_ = 0, buffers_[2] = {};
  GLsizei index_count_ = 0;
};

}  // namespace material
