#include "sdk/src/gl/nnao/frame_record.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/state_guard.h"
#include "sdk/src/nnao/host_depth.h"

namespace nook::gl {

TexelReader::TexelReader(Device& device, int width)
    : device_(device),
      program_(draw_program(device, "nnao/screen.vert", "nnao/texel_bits.frag", "")),
      sampler_(Object::make(device, Object::Kind::sampler)),
      vertex_array_(Object::make(device, Object::Kind::vertex_array)),
      strip_(device, TextureFormat::texel_bits, width, texel_strip_rows, "nook: texels to read"),
      bits_(std::size_t(width) * texel_strip_rows * 4, 0, device.memory) {
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    device.gl.SamplerParameteri(sampler_.name(), filter, GL_NEAREST);
}

Vector<float> TexelReader::read(GLuint texture, const Viewport& viewport, int channels) {
  const Functions& gl = device_.gl;
  Vector<float> values(device_.memory);
  values.reserve(std::size_t(viewport.width) * std::size_t(viewport.height) * std::size_t(channels));
  set_plain_drawing(gl);
  set_pixel_pack(gl, {});
  gl.BindVertexArray(vertex_array_.name());
  gl.UseProgram(program_.name());
  gl.Uniform1i(uniform_location(device_, program_, "nook_image"), 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.BindSampler(0, sampler_.name());
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  for (const GLenum target : {GL_DRAW_FRAMEBUFFER, GL_READ_FRAMEBUFFER})
    gl.BindFramebuffer(target, strip_.framebuffer());
  const GLint first = uniform_location(device_, program_, "nook_first");
  for (int y = 0; y < viewport.height; y += texel_strip_rows) {
    const int rows = std::min(texel_strip_rows, viewport.height - y);
    set_viewport(gl, {0, 0, float(viewport.width), float(rows)});
    gl.Uniform2i(first, viewport.x, viewport.y + y);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    // For integers, this is the only format that OpenGL ES guarantees to read back.
    gl.ReadPixels(0, 0, viewport.width, rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits_.data());
    device_.check("reading texels back");
    const std::size_t texels = std::size_t(viewport.width) * std::size_t(rows);
    for (std::size_t i = 0; i < texels; ++i)
      for (int channel = 0; channel < channels; ++channel)
        values.push_back(bit_cast<float>(bits_[4 * i + std::size_t(channel)]));
  }
  return values;
}

namespace {

// Copies one of the driver's strings, changed so that it is valid in a recording.
void copy_driver_text(const Functions& gl, GLenum name, String& text) {
  const auto* given = reinterpret_cast<const char*>(gl.GetString(name));
  if (!given) return;
  text.assign(given, std::min(std::strlen(given), nnao::max_recorded_text));
  for (char& c : text)
    if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7f) c = '?';
}

void copy_note(const char* note, String& text) {
  if (!note) return;
  const void* const end = std::memchr(note, 0, nnao::max_recorded_text + 1);
  if (!end)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "note is too long (need at most %zu bytes)",
                  nnao::max_recorded_text);
  text.assign(note, static_cast<const char*>(end));
}

// Returns a copy of the frame that draws to the pass's own texture, so that the host's targets are not
// changed.
NnaoFrame own_target(NnaoFrame frame) {
  frame.target = NOOK_TARGET_OWN;
  frame.target_name = 0;
  frame.blend = NOOK_BLEND_WRITE;
  if (frame.show == NOOK_NNAO_VIEW_NORMALS) frame.show = NOOK_NNAO_VIEW_AO;
  return frame;
}

void copy_settings(const NnaoFrame& from, nnao::RecordedFrame& to) {
  to.depth_kind = from.depth_kind;
  to.clip = from.clip_space;
  to.sky_depth = from.sky_depth;
  to.normal_scale = from.normal_scale;
  to.normal_bias = from.normal_bias;
  std::copy(std::begin(from.normal_matrix), std::end(from.normal_matrix), to.normal_matrix);
  std::copy(std::begin(from.projection), std::end(from.projection), to.projection);
  to.radius = from.radius;
  to.max_radius_px = from.max_radius_px;
  to.intensity = from.intensity;
  to.power = from.power;
  to.layer = from.gbuffer_ao;
  to.view = from.show;
  to.radius_kind = from.radius_kind;
  to.min_radius_px = from.min_radius_px;
  to.fade_begin = from.fade_begin;
  to.fade_end = from.fade_end;
}

// Replaces some settings by simpler settings that give the same result. Logarithmic depth becomes linear
// depth, and a radius relative to the scene becomes metres.
void simplify(nnao::Recording& recording, const NnaoFrame& frame) {
  if (frame.radius_kind == NOOK_NNAO_RADIUS_SCENE) {
    recording.frame.radius = frame.radius * frame.scene_size;
    recording.frame.radius_kind = NOOK_NNAO_RADIUS_METRES;
  }
  if (frame.depth_kind != NOOK_DEPTH_LOGARITHMIC) return;
  const nnao::DepthDecode decode =
      nnao::depth_decode({frame.projection, nnao::DepthKind::logarithmic, nnao::ClipRange(frame.clip_space),
                          frame.sky_depth, frame.depth_log_scale, frame.depth_log_near, frame.depth_log_far});
  for (float& depth : recording.depth) depth = nnao::view_depth(decode, true, depth);
  recording.frame.depth_kind = NOOK_DEPTH_LINEAR;
  recording.frame.sky_depth = 0;
}

// For formats with normalised integers: if a texel is too short to be a normal, replaces it by the texel of a
// zero vector. This is needed because a recording does not store the host's format, and a zero vector is too
// short in every format.
void zero_short_normals(const NnaoFrame& frame, Vector<float>& texels) {
  const double shortest = double(nnao::shortest_normalised_normal) * nnao::mean_scale(frame.normal_matrix);
  const float* const m = frame.normal_matrix;
  for (std::size_t i = 0; i + 2 < texels.size(); i += 3) {
    double n[3], square = 0;
    for (std::size_t k = 0; k < 3; ++k) n[k] = texels[i + k] * frame.normal_scale + frame.normal_bias;
    for (int row = 0; row < 3; ++row) {
      const double turned = m[row] * n[0] + m[3 + row] * n[1] + m[6 + row] * n[2];
      square += turned * turned;
    }
    if (square > shortest * shortest) continue;
    for (std::size_t k = 0; k < 3; ++k) texels[i + k] = -frame.normal_bias / frame.normal_scale;
  }
}

// Reads the AO of the pass. It is in the red channel, or in alpha if the pass has bent normals.
Vector<float> ao_of(TexelReader& reader, const NnaoPass& pass, const nook_nnao_desc& made_with,
                    const Viewport& viewport) {
  if (!made_with.bent_normals) return reader.read(pass.ao_texture(), viewport, 1);
  Vector<float> texels = reader.read(pass.ao_texture(), viewport, 4);
  for (std::size_t i = 0; 4 * i < texels.size(); ++i) texels[i] = texels[4 * i + 3];
  texels.resize(texels.size() / 4);
  return texels;
}

}  // namespace

nnao::Recording record_frame(Device& device, NnaoPass& pass, const nook_nnao_desc& made_with,
                             std::span<const std::byte> network, const NnaoFrame& frame, const char* note) {
  NnaoFrame drawn = own_target(frame);
  const Viewport viewport = viewport_of(frame);
  nnao::Recording recording(device.memory);
  copy_note(note, recording.note);
  pass.render(drawn);
  TexelReader reader(device, viewport.width);
  recording.depth = reader.read(frame.depth_texture, viewport, 1);
  if (frame.normal_texture) {
    recording.normals = reader.read(frame.normal_texture, viewport, 3);
    if (drawn.normalised_normals) zero_short_normals(drawn, recording.normals);
  }
  if (frame.gbuffer_ao != NOOK_GBUFFER_AO_NONE)
    recording.layer = reader.read(frame.gbuffer_ao_texture, viewport, 2);
  recording.ao = ao_of(reader, pass, made_with, viewport);
  // AO has 8 bits, but some drivers divide by 255 inexactly. So each value is rounded to the nearest multiple
  // of 1 / 255.
  for (float& ao : recording.ao) ao = std::round(255 * std::clamp(ao, 0.0f, 1.0f)) / 255;
  recording.width = std::uint32_t(viewport.width);
  recording.height = std::uint32_t(viewport.height);
  recording.library_version = NOOK_VERSION;
  copy_settings(drawn, recording.frame);
  simplify(recording, drawn);
  recording.pass = {made_with.taps, made_with.half_resolution, made_with.blur, made_with.blur_sharpness,
                    pass.path()};
  recording.network.assign(network.begin(), network.end());
  copy_driver_text(device.gl, GL_VENDOR, recording.vendor);
  copy_driver_text(device.gl, GL_RENDERER, recording.renderer);
  copy_driver_text(device.gl, GL_VERSION, recording.driver_version);
  nnao::check_recording(recording);
  return recording;
}

}  // namespace nook::gl
