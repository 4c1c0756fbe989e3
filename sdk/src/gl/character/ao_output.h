// Copies AO on the GPU to where a host wants it: its own buffer, in numbers of 32, 16 or 8 bits, or a
// texture.
#pragma once

#include <nook/nook_gl.h>

#include <array>

#include "sdk/src/gl/character/tier.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

struct BufferTarget {
  GLuint buffer = 0;
  std::uint64_t offset = 0;  // bytes, a multiple of 4
  std::uint32_t stride = 0;  // bytes between values; 0: tightly packed
  nook_format format = NOOK_FORMAT_FLOAT;
};

struct TextureTarget {
  GLuint texture = 0;
  std::uint64_t first_texel = 0;           // row by row
  std::uint32_t width = 0;                 // texels; 0: query it
  nook_format format = NOOK_FORMAT_FLOAT;  // of the texture; only OpenGL ES needs it
};

// Returns the bytes of tightly packed values, rounded up to whole words.
std::uint64_t packed_bytes(nook_format format, std::uint32_t values);

// Makes the program for each kind of target when it is first written. The caller must hold a StateGuard for
// output_users.
class AoOutput {
 public:
  explicit AoOutput(Device& device) : device_(device) {}

  // Both throw Failure if the target is not a buffer or texture, or too small; UNSUPPORTED for a stride
  // without compute shaders.
  void write(const VertexValues& source, const BufferTarget& target);
  void write(const VertexValues& source, const TextureTarget& target);

 private:
  void write_packed(const VertexValues& source, const BufferTarget& target);
  void write_strided(const VertexValues& source, const BufferTarget& target);
  void make_draw_objects();
  void write_rows(const VertexValues& source, const TextureTarget& target);

  static constexpr int format_count = 3;

  Device& device_;
  std::array<Object, format_count> packing_;  // programs, by format
  std::array<Object, format_count> strided_;
  Object vertex_array_;
  FeedbackTarget feedback_;
  Buffer packed_;  // for textures on OpenGL ES
};

// Returns the users of touched state that a write has.
unsigned output_users(const Functions& gl);

}  // namespace nook::gl
