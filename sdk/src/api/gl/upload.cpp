#include "sdk/src/api/gl/upload.h"

#include <nook/experimental/nook_synthesis.h>

#include <algorithm>
#include <string_view>
#include <type_traits>

#include "sdk/src/api/clips_handle.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/material_handle.h"
#include "sdk/src/api/probe_handles.h"
#include "sdk/src/api/synthesis_handle.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/functions.h"
#include "sdk/src/gl/texel_table.h"

using namespace nook;

constexpr std::size_t max_textures = std::extent_v<decltype(nook_gl_upload_info::textures)>;
static_assert(gl::MaterialTextures::max_textures == max_textures);

namespace {

void put(nook_gl_upload_info& info, GLenum target, GLuint texture, const char* uniform) {
  info.textures[info.texture_count++] = {target, texture, uniform};
}

// Fills nook_gl_upload_info. There is one function for each kind of content.
struct Describe {
  const gl::Device& device;
  nook_gl_upload_info& info;

  void operator()(std::monostate) const {}
  void operator()(const gl::ProbeTexture& probe) const {
    put(info, gl::TexelTable::target(device), probe.name(), "nook_probe_texels");
    info.bytes = probe.bytes();
    info.glsl = gl::probe_glsl();
  }
  void operator()(const gl::GridVolume& grid) const {
    put(info, GL_TEXTURE_3D, grid.name(), "nook_grid_texels");
    info.bytes = grid.bytes();
    info.glsl = grid.source().c_str();
    info.constant = "nook_grid_frame";
    std::copy(grid.frame().begin(), grid.frame().end(), info.constant_values);
    info.constant_vec4s = 4;
    info.walls = grid.walls();
  }
  void operator()(const gl::MaterialTextures& material) const {
    for (const gl::MaterialTextures::Texture& texture : material.textures())
      put(info, GL_TEXTURE_2D_ARRAY, texture.object.name(), texture.uniform);
    info.bytes = material.bytes();
    info.glsl = material.source().c_str();
  }
  void operator()(const gl::CoordinateTexture& coordinates) const {
    put(info, GL_TEXTURE_2D_ARRAY, coordinates.name(), "nook_synthesis_texels");
    info.bytes = coordinates.bytes();
    info.glsl = coordinates.source().c_str();
  }
  void operator()(const gl::TransferTexture& vectors) const {
    put(info, gl::TexelTable::target(device), vectors.name(), "nook_transfer_texels");
    info.bytes = vectors.bytes();
    info.glsl = vectors.source().c_str();
  }
  void operator()(const api::PaperUpload& paper) const {
    put(info, gl::TexelTable::target(device), paper.texture.light(), "nook_transfer_texels");
    put(info, gl::TexelTable::target(device), paper.texture.vertices(), "nook_transfer_vertices");
    info.bytes = paper.texture.bytes();
    info.glsl = paper.texture.source().c_str();
  }
  void operator()(const gl::ClipTextures& clips) const {
    put(info, GL_TEXTURE_2D, clips.modes(), "nook_clip_modes");
    put(info, GL_TEXTURE_2D, clips.weights(), "nook_clip_weights");
    info.bytes = clips.bytes();
    info.glsl = gl::clips_glsl();
    info.constant = "nook_clip_vec4s";
    info.constant_values[0] = static_cast<float>(clips.vec4s());
  }
};

nook_gl_upload_info info_of(const nook_gl_upload_s& upload) {
  nook_gl_upload_info info{};
  std::visit(Describe{upload.gl->device, info}, upload.content);
  return info;
}

// A kind of upload, and the name of a sampler that only the GLSL of this kind has.
struct Mark {
  const char* uniform;
  const char* kind;
};
constexpr Mark marks[] = {{"nook_probe_texels", "a probe of lobes"},
                          {"nook_grid_texels", "a grid of diffuse light"},
                          {"nook_light_map", "a material"},
                          {"nook_neural_features", "a neural material"},
                          {"nook_synthesis_texels", "a coordinate texture"},
                          {"nook_transfer_texels", "a transfer"},
                          {"nook_clip_modes", "clips"}};

const char* kind_of(std::string_view uniform) {
  for (const Mark& mark : marks)
    if (uniform == mark.uniform) return mark.kind;
  return "a material";
}

// Throws the Failure for a program that has no sampler of this upload. If the program has a sampler of
// another kind of upload, the message names it.
[[noreturn]] void fail_kind(const gl::Functions& gl, GLuint program, const nook_gl_upload_info& info) {
  for (const Mark& mark : marks)
    if (gl.GetUniformLocation(program, mark.uniform) >= 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "program cannot use this upload of %s: it has the sampler %s, which belongs to %s (need "
                    "the sampler %s); compile it with the GLSL of this upload",
                    kind_of(info.textures[0].uniform), mark.uniform, mark.kind, info.textures[0].uniform);
  throw Failure(
      NOOK_ERROR_INVALID_ARGUMENT,
      "program cannot use this upload of %s (need the sampler %s); compile it with the GLSL of this upload "
      "and call its functions. If no shader of the program reads the upload's textures, do not bind it",
      kind_of(info.textures[0].uniform), info.textures[0].uniform);
}

void check_program(const gl::Functions& gl, GLuint program) {
  GLint linked = GL_FALSE;
  if (gl.IsProgram(program)) gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "program is not the name of a linked program (got %u); link it first", program);
}

void check_units(const gl::Functions& gl, std::uint32_t first_unit, std::uint32_t count) {
  const auto units = static_cast<std::uint32_t>(gl::integer(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
  if (first_unit > units || count > units - first_unit)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "first_unit is too large (got %u for %u textures, need all units below %u)", first_unit,
                  count, units);
}

void bind(const gl::Functions& gl, const nook_gl_upload_info& info, GLuint program,
          std::uint32_t first_unit) {
  GLint locations[max_textures];
  bool any = false;
  for (std::uint32_t i = 0; i < info.texture_count; ++i) {
    locations[i] = gl.GetUniformLocation(program, info.textures[i].uniform);
    any = any || locations[i] >= 0;
  }
  if (!any) fail_kind(gl, program, info);
  gl.UseProgram(program);
  for (std::uint32_t i = 0; i < info.texture_count; ++i) {
    const std::uint32_t unit = first_unit + i;
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(info.textures[i].target, info.textures[i].texture);
    gl.BindSampler(unit, 0);
    // OpenGL ignores the location -1.
    gl.Uniform1i(locations[i], static_cast<GLint>(unit));
  }
  if (info.constant && info.constant_vec4s == 0)
    gl.Uniform1i(gl.GetUniformLocation(program, info.constant), static_cast<GLint>(info.constant_values[0]));
  else if (info.constant)
    gl.Uniform4fv(gl.GetUniformLocation(program, info.constant), static_cast<GLsizei>(info.constant_vec4s),
                  info.constant_values);
}

void need_form(nook_gl_probe_form form) {
  check_known("form", form, NOOK_GL_PROBE_LOBES);
}

}  // namespace

nook_gl_upload api::upload_material(nook_gl gl, nook_material material, std::uint32_t max_layers) {
  return make_upload<gl::MaterialTextures>(gl, gl::materials, material->tables, max_layers);
}

nook_result nook_gl_upload_probe(nook_gl gl, nook_probe probe, nook_gl_probe_form form, nook_gl_upload* out) {
  return api::enter("nook_gl_upload_probe", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(probe, "probe");
    need_form(form);
    if (form == NOOK_GL_PROBE_LOBES)
      *out = api::make_upload<gl::ProbeTexture>(gl, gl::probe_users(gl->device.gl), probe->probes);
    else
      *out = api::make_upload<gl::GridVolume>(gl, gl::grids, probe->probes, gl::GridForm(form));
  });
}

nook_result nook_gl_update_probe(nook_gl_upload upload, nook_probe probe) {
  return api::enter("nook_gl_update_probe", [&] {
    need(upload, "upload");
    need(probe, "probe");
    nook_gl_s& gl = *upload->gl;
    gl.device.need_alive();
    gl.device.report_host_errors();
    if (gl::ProbeTexture* const lobes = upload->probe())
      gl.guarded(gl::probe_users(gl.device.gl), [&] { lobes->update(probe->probes); });
    else if (gl::GridVolume* const grid = upload->grid())
      gl.guarded(gl::grids, [&] { grid->update(probe->probes); });
    else
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "upload is %s, not a probe; pass an upload that nook_gl_upload_probe created",
                    kind_of(info_of(*upload).textures[0].uniform));
  });
}

nook_result nook_gl_upload_material(nook_gl gl, nook_material material, nook_gl_upload* out) {
  return api::enter("nook_gl_upload_material", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(material, "material");
    *out = api::upload_material(gl, material, 0);
  });
}

nook_result nook_gl_upload_clips(nook_gl gl, nook_clips clips, nook_gl_upload* out) {
  return api::enter("nook_gl_upload_clips", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(clips, "clips");
    *out = api::make_upload<gl::ClipTextures>(gl, gl::clips, *clips, clips->set.ao.modes);
  });
}

nook_result nook_gl_upload_describe(nook_gl_upload upload, nook_gl_upload_info* info) {
  return api::enter("nook_gl_upload_describe", [&] {
    need(upload, "upload");
    upload->gl->device.need_current();
    write_info(info, info_of(*upload));
  });
}

nook_result nook_gl_upload_synthesis(nook_gl gl, nook_synthesis synthesis, nook_gl_upload* out) {
  return api::enter("nook_gl_upload_synthesis", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(synthesis, "synthesis");
    *out = api::make_upload<gl::CoordinateTexture>(gl, gl::materials, synthesis->coordinates);
  });
}

nook_result nook_gl_upload_bind(nook_gl_upload upload, uint32_t program, uint32_t first_unit) {
  return api::enter("nook_gl_upload_bind", [&] {
    need(upload, "upload");
    nook_gl_s& gl = *upload->gl;
    gl.device.need_alive();
    const nook_gl_upload_info info = info_of(*upload);
    check_program(gl.device.gl, program);
    check_units(gl.device.gl, first_unit, info.texture_count);
    gl.guarded(gl::binds, [&] { bind(gl.device.gl, info, program, first_unit); });
  });
}

void nook_gl_upload_destroy(nook_gl_upload* upload) {
  if (!upload || !*upload) return;
  (*upload)->release();
  *upload = nullptr;
}
