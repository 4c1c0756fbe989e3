// Stores the vectors of a shape's vertices in a table of texels, and returns the GLSL that reads them.
#pragma once

#include <span>
#include <string>

#include "sdk/src/gl/texel_table.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::gl {

class TransferTexture {
 public:
  // light_modes must be a multiple of 4. The constructor and update change GL_ARRAY_BUFFER and the table's
  // texture target of unit 0, and may throw Failure.
  TransferTexture(Device& device, std::uint32_t light_modes, std::uint32_t vertices);
  // Replaces all vectors. Pass vertices x 3 x light_modes floats.
  void update(std::span<const float> vectors);

  std::uint64_t float_count() const { return 4 * texels_; }
  GLuint name() const { return table_.texture(); }
  std::uint64_t bytes() const { return table_.bytes(); }
  const String& source() const { return source_; }

 private:
  Device& device_;
  std::uint64_t texels_;
  TexelTable table_;
  String source_;
};

// Stores the paper's form in two tables of texels, one for the light and one for the vertices, and returns
// the GLSL that mixes them.

class PaperTexture {
 public:
  // The constructor and update change GL_ARRAY_BUFFER and the tables' texture target of unit 0, and may throw
  // Failure.
  PaperTexture(Device& device, const transfer::Transfer& transfer);
  // Replaces the light. fill(rows) must write the same data as transfer::write_lit_rows.
  template <class Fill>
  void update(Fill&& fill) {
    light_.write(device_, light_texels_, [&](void* memory) {
      fill(std::span(static_cast<float*>(memory), std::size_t(4 * light_texels_)));
    });
  }

  GLuint light() const { return light_.texture(); }
  GLuint vertices() const { return vertices_.texture(); }
  std::uint64_t bytes() const { return light_.bytes() + vertices_.bytes(); }
  const String& source() const { return source_; }

 private:
  Device& device_;
  std::uint64_t light_texels_;
  TexelTable light_, vertices_;
  String source_;
};

}  // namespace nook::gl
