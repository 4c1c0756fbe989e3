#include "sdk/src/gl/character/ao_output.h"

#include <algorithm>
#include <cstdio>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/state_guard.h"

namespace nook::gl {
namespace {

constexpr std::uint32_t values_per_word(nook_format format) {
  return 1u << format;
}

const void* at_byte(std::uint64_t offset) {
  return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset));
}

struct PackDefines {
  char text[48];
  explicit PackDefines(nook_format format) {
    std::snprintf(text, sizeof text, "#define NOOK_VALUES_PER_WORD %u\n", values_per_word(format));
  }
};

// Returns the size of a host's buffer in bytes. Throws Failure if OpenGL rejects the buffer.
std::uint64_t size_of_buffer(const Device& device, GLuint buffer) {
  GLint64 size = 0;
  device.gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  device.gl.GetBufferParameteri64v(GL_ARRAY_BUFFER, GL_BUFFER_SIZE, &size);
  device.check("binding the host's buffer");
  return static_cast<std::uint64_t>(size);
}

}  // namespace

std::uint64_t packed_bytes(nook_format format, std::uint32_t values) {
  const std::uint32_t each = values_per_word(format);
  return (std::uint64_t{values} + each - 1) / each * 4;
}

unsigned output_users(const Functions& gl) {
  return gl.can.compute ? outputs | outputs_compute : unsigned{outputs};
}

void AoOutput::write(const VertexValues& source, const BufferTarget& target) {
  const std::uint64_t bytes = target.stride ? std::uint64_t{target.stride} * (source.vertices - 1) + 4
                                            : packed_bytes(target.format, source.vertices);
  const std::uint64_t size = size_of_buffer(device_, target.buffer);
  if (target.offset > size || bytes > size - target.offset)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.buffer %u is too small (it has %llu bytes, but the values would end at byte %llu)",
                  target.buffer, static_cast<unsigned long long>(size),
                  static_cast<unsigned long long>(target.offset + bytes));
  if (target.stride)
    write_strided(source, target);
  else
    write_packed(source, target);
  device_.check("writing AO to the host's buffer");
}

void AoOutput::make_draw_objects() {
  if (vertex_array_.name()) return;
  const Functions& gl = device_.gl;
  feedback_ = FeedbackTarget(device_);
  vertex_array_ = Object::make(device_, Object::Kind::vertex_array);
  gl.BindVertexArray(vertex_array_.name());
  gl.EnableVertexAttribArray(0);
}

// Each vertex of the draw packs one word. If the last word is not full, it is drawn separately, so that
// nothing beyond the end of the source is read.
void AoOutput::write_packed(const VertexValues& source, const BufferTarget& target) {
  const Functions& gl = device_.gl;
  Object& program = packing_[static_cast<std::size_t>(target.format)];
  if (!program.name())
    program = feedback_program(device_, "character/pack.vert", PackDefines(target.format).text, "nook_word");
  make_draw_objects();
  gl.UseProgram(program.name());
  gl.BindVertexArray(vertex_array_.name());
  feedback_.begin(device_);
  gl.BindBuffer(GL_ARRAY_BUFFER, source.buffer);
  const std::uint32_t each = values_per_word(target.format), whole = source.vertices / each;
  const auto draw = [&](std::uint32_t first_word, std::uint32_t words, std::uint32_t values) {
    if (words == 0 || values == 0) return;
    gl.VertexAttribPointer(0, static_cast<GLint>(values), GL_FLOAT, GL_FALSE,
                           static_cast<GLsizei>(4 * values),
                           at_byte(source.offset + std::uint64_t{4} * each * first_word));
    gl.BindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, target.buffer,
                       static_cast<GLintptr>(target.offset + std::uint64_t{4} * first_word),
                       static_cast<GLsizeiptr>(std::uint64_t{4} * words));
    gl.BeginTransformFeedback(GL_POINTS);
    gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(words));
    gl.EndTransformFeedback();
  };
  draw(0, whole, each);
  draw(whole, 1, source.vertices - whole * each);
  // Removes the host's or chunk's buffer from the vertex array. Otherwise the vertex array would keep the
  // buffer alive after its deletion.
  FeedbackTarget::end(device_);
}

void AoOutput::write_strided(const VertexValues& source, const BufferTarget& target) {
  const Functions& gl = device_.gl;
  if (!gl.can.compute)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "target.stride needs compute shaders (OpenGL 4.3 or OpenGL ES 3.1), which this context "
                  "does not have; leave target.stride 0 and read the values as a separate vertex attribute");
  Object& program = strided_[static_cast<std::size_t>(target.format)];
  if (!program.name())
    program = compute_program(device_, "character/pack_strided.comp", PackDefines(target.format).text);
  // OpenGL requires that a bound range of a storage buffer starts at a multiple of this alignment.
  const std::uint64_t alignment = device_.storage_alignment;
  const std::uint64_t source_begin = source.offset / alignment * alignment;
  const std::uint64_t target_begin = target.offset / alignment * alignment;
  const std::uint64_t source_end = source.offset + source.bytes();
  const std::uint64_t target_end = target.offset + std::uint64_t{target.stride} * (source.vertices - 1) + 4;
  if (target_end - target_begin > device_.max_piece_bytes)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the values of an instance span %llu bytes, but this OpenGL can write at most %llu; use a "
                  "smaller target.stride",
                  static_cast<unsigned long long>(target_end - target_begin),
                  static_cast<unsigned long long>(device_.max_piece_bytes));
  gl.UseProgram(program.name());
  gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, source.buffer, static_cast<GLintptr>(source_begin),
                     static_cast<GLsizeiptr>(source_end - source_begin));
  gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, 1, target.buffer, static_cast<GLintptr>(target_begin),
                     static_cast<GLsizeiptr>(target_end - target_begin));
  gl.Uniform1ui(0, source.vertices);
  gl.Uniform1ui(1, static_cast<GLuint>((source.offset - source_begin) / 4));
  gl.Uniform1ui(2, static_cast<GLuint>((target.offset - target_begin) / 4));
  gl.Uniform1ui(3, target.stride / 4);
  gl.DispatchCompute((source.vertices + 63) / 64, 1, 1);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                   GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

namespace {

// Returns the width of the target texture. If OpenGL reports the size of textures, checks the size and throws
// Failure if the texture is not suitable.
std::uint32_t checked_width(const Device& device, const VertexValues& source, const TextureTarget& target) {
  const Functions& gl = device.gl;
  if (!gl.can.texture_sizes) {
    if (target.width == 0)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "target.texture_width is 0 (%s %d.%d cannot report it); set it to the width of the texture",
          api_name(gl), gl.version / 10, gl.version % 10);
    return target.width;
  }
  GLint width = 0, height = 0;
  gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
  gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
  if (target.width != 0 && target.width != static_cast<std::uint32_t>(width))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.texture_width differs from the width of texture %u (got %u, need %d or 0)",
                  target.texture, target.width, width);
  const std::uint64_t texels = std::uint64_t(width) * std::uint64_t(height);
  if (target.first_texel > texels || source.vertices > texels - target.first_texel)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "target.texture %u is too small (it has %d x %d texels, but the values would end at texel %llu)",
        target.texture, width, height, static_cast<unsigned long long>(target.first_texel + source.vertices));
  return static_cast<std::uint32_t>(width);
}

// In OpenGL ES, an upload must have the type of the texture's format. Only OpenGL ES 3.1 and later report
// this type.
void check_format(const Device& device, const TextureTarget& target) {
  const Functions& gl = device.gl;
  if (gl.profile == Profile::desktop || !gl.can.texture_sizes) return;
  GLint type = GL_NONE, bits = 0;
  gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_RED_TYPE, &type);
  gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_RED_SIZE, &bits);
  const bool is_float = type == GL_FLOAT;
  const bool fits = target.format == NOOK_FORMAT_FLOAT  ? is_float
                    : target.format == NOOK_FORMAT_HALF ? is_float && bits == 16
                                                        : type == GL_UNSIGNED_NORMALIZED && bits == 8;
  if (!fits)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.format differs from the format of texture %u (got %d, but its red channel has %d "
                  "bits; OpenGL ES needs NOOK_FORMAT_FLOAT for GL_R32F, NOOK_FORMAT_HALF for GL_R16F, "
                  "NOOK_FORMAT_UNORM8 for GL_R8)",
                  target.texture, target.format, bits);
}

struct UploadType {
  GLenum type;
  std::uint32_t bytes;
};

constexpr UploadType type_of(nook_format format) {
  switch (format) {
    case NOOK_FORMAT_HALF:
      return {GL_HALF_FLOAT, 2};
    case NOOK_FORMAT_UNORM8:
      return {GL_UNSIGNED_BYTE, 1};
    default:
      return {GL_FLOAT, 4};
  }
}

}  // namespace

void AoOutput::write(const VertexValues& source, const TextureTarget& target) {
  if (device_.gl.profile == Profile::desktop || target.format == NOOK_FORMAT_FLOAT) {
    write_rows(source, {target.texture, target.first_texel, target.width, NOOK_FORMAT_FLOAT});
    return;
  }
  // OpenGL ES does not convert on upload, so we convert first.
  const std::uint64_t bytes = packed_bytes(target.format, source.vertices);
  if (packed_.bytes() < bytes) packed_ = Buffer(device_, "nook: packed AO", bytes, nullptr, GL_DYNAMIC_COPY);
  write_packed(source, {packed_.name(), 0, 0, target.format});
  write_rows({packed_.name(), 0, source.vertices, 1}, target);
}

void AoOutput::write_rows(const VertexValues& source, const TextureTarget& target) {
  const Functions& gl = device_.gl;
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, target.texture);
  device_.check("binding the host's texture");
  const std::uint32_t width = checked_width(device_, source, target);
  check_format(device_, target);
  const UploadType upload = type_of(target.format);
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, source.buffer);
  PixelStore tight;
  tight.values[0] = 1;
  set_pixel_store(gl, tight);
  // First writes the remaining part of the first row, then whole rows, then the beginning of the last row.
  std::uint32_t written = 0;
  while (written < source.vertices) {
    const std::uint64_t texel = target.first_texel + written;
    const auto x = static_cast<std::uint32_t>(texel % width), y = static_cast<std::uint32_t>(texel / width);
    const std::uint32_t left = source.vertices - written, row = width - x;
    const bool rows = x == 0 && left >= width;
    const std::uint32_t across = std::min(row, left), down = rows ? left / width : 1;
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(x), static_cast<GLint>(y),
                     static_cast<GLsizei>(across), static_cast<GLsizei>(down), GL_RED, upload.type,
                     at_byte(source.offset + std::uint64_t{upload.bytes} * written));
    written += across * down;
  }
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  device_.check(
      "writing AO to the host's texture (on OpenGL ES, target.format must match the format of the texture)");
}

}  // namespace nook::gl
