// Copies AO from buffers of Nook to a buffer or texture of the host, on the GPU. Values have 32, 16 or 8
// bits.
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
  std::uint64_t first_texel = 0;           // index of the first texel to write, counted row by row
  std::uint32_t width = 0;                 // width of the texture in texels; 0: query it from OpenGL
  nook_format format = NOOK_FORMAT_FLOAT;  // format of the texture; only used on OpenGL ES
};

// Returns the size of tightly packed values in bytes, rounded up to whole words.
std::uint64_t packed_bytes(nook_format format, std::uint32_t values);

// Compiles the program for a kind of target when a target of this kind is written for the first time. The
// caller must hold a StateGuard for output_users.
class AoOutput {
 public:
  explicit AoOutput(Device& device) : device_(device) {}

  // Both functions throw Failure if the target is not a buffer or texture, or is too small. They throw
  // Failure(UNSUPPORTED) if a stride is given and the context has no compute shaders.
  void write(const VertexValues& source, const BufferTarget& target);
  void write(const VertexValues& source, const TextureTarget& target);

 private:
  void write_packed(const VertexValues& source, const BufferTarget& target);
  void write_strided(const VertexValues& source, const BufferTarget& target);
  void make_draw_objects();
  void write_rows(const VertexValues& source, const TextureTarget& target);

  static constexpr int format_count = 3;

  Device& device_;
  std::array<Object, format_count> packing_;  // programs, one for each format
  std::array<Object, format_count> strided_;
  Object vertex_array_;
  FeedbackTarget feedback_;
  Buffer packed_;  // packed values before they are copied to a texture; only used on OpenGL ES
};

// Returns the users (touched_state.h) whose OpenGL state a write changes.
unsigned output_users(const Functions& gl);

}  // namespace nook::gl
