#include "samples/material/mesh.h"

#include <cstddef>
#include <utility>

namespace material {

Mesh::Mesh(const GladGLContext& gl, const Shape& shape)
    : gl_(gl), index_count_(GLsizei(shape.indices.size())) {
  gl.GenVertexArrays(1, &vertex_array_);
  gl.BindVertexArray(vertex_array_);
  gl.GenBuffers(2, buffers_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  gl.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(shape.vertices.size() * sizeof(Vertex)), shape.vertices.data(),
                GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(shape.indices.size() * sizeof(std::uint32_t)),
                shape.indices.data(), GL_STATIC_DRAW);
  const struct {
    GLint size;
    std::size_t offset;
  } fields[] = {{3, offsetof(Vertex, position)},
                {3, offsetof(Vertex, normal)},
                {3, offsetof(Vertex, tangent)},
                {2, offsetof(Vertex, uv)}};
  for (GLuint slot = 0; slot < 4; ++slot) {
    gl.EnableVertexAttribArray(slot);
    gl.VertexAttribPointer(slot, fields[slot].size, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                           reinterpret_cast<const void*>(fields[slot].offset));
  }
  gl.BindVertexArray(0);
}

Mesh::Mesh(Mesh&& other) noexcept
    : gl_(other.gl_),
      vertex_array_(std::exchange(other.vertex_array_, 0)),
      buffers_{std::exchange(other.buffers_[0], 0), std::exchange(other.buffers_[1], 0)},
      index_count_(other.index_count_) {}

Mesh::~Mesh() {
  gl_.DeleteVertexArrays(1, &vertex_array_);
  gl_.DeleteBuffers(2, buffers_);
}

void Mesh::draw() const {
  gl_.BindVertexArray(vertex_array_);
  gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace material
