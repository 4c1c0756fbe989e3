#include "sdk/src/gl/probe/grid_volume.h"

#include <algorithm>
#include <utility>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/program.h"
#include "sdk/src/gl/state_guard.h"

namespace nook::gl {
namespace {

void check_size(const Device& device, const GridTexelPlan& plan) {
  GLint most = 0;
  device.gl.GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
  if (*std::max_element(plan.size.begin(), plan.size.end()) > std::uint32_t(std::max(most, 0)))
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the grid is too large for a 3D texture of this OpenGL (got %u x %u x %u texels, need at "
                  "most %d each); split the grid",
                  plan.size[0], plan.size[1], plan.size[2], most);
}

String source_of(GridForm form, bool walls, Memory* memory) {
  String source(memory);
  source += form == GridForm::harmonics ? "#define NOOK_GRID_TEXELS NOOK_GRID_HARMONICS_TEXELS\n"
                                        : "#define NOOK_GRID_TEXELS NOOK_GRID_ZONAL_TEXELS\n";
  if (walls) source += "#define NOOK_GRID_WALLS 1\n";
  source += embedded_text("probe/volume/host.glsl");
  return source;
}

}  // namespace

GridVolume::GridVolume(Device& device, const probe::Probes& probes, GridForm form)
    : device_(device), form_(form), source_(device.memory) {
  update(probes);
}

void GridVolume::update(const probe::Probes& probes) {
  const GridTexelPlan plan = plan_grid(probes, form_);
  check_size(device_, plan);
  const Vector<std::uint16_t> texels = grid_texels(probes, plan, device_.memory);
  String source = source_of(form_, probes.walls.any(), device_.memory);
  const Functions& gl = device_.gl;
  Object made;
  if (!texture_.name()) made = Object::make(device_, Object::Kind::texture);
  const GLuint name = texture_.name() ? texture_.name() : made.name();
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_3D, name);
  const std::pair<GLenum, GLint> parameters[] = {{GL_TEXTURE_MAX_LEVEL, 0},
                                                 {GL_TEXTURE_MIN_FILTER, GL_LINEAR},
                                                 {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                                 {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                                 {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
                                                 {GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE}};
  for (const auto& [parameter, value] : parameters) gl.TexParameteri(GL_TEXTURE_3D, parameter, value);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  set_pixel_store(gl, {});
  gl.TexImage3D(GL_TEXTURE_3D, 0, GL_RGBA16F, GLsizei(plan.size[0]), GLsizei(plan.size[1]),
                GLsizei(plan.size[2]), 0, GL_RGBA, GL_HALF_FLOAT, texels.data());
  device_.check("uploading a grid of probes");
  device_.label(GL_TEXTURE, name, "nook: grid of probes");
  if (!texture_.name()) texture_ = std::move(made);
  bytes_ = plan.texels() * 4 * sizeof(std::uint16_t);
  source_ = std::move(source);
  frame_ = grid_frame(probes, plan);
  walls_ = probes.walls.any();
  grid_ = probes.grid;
}

// The texels of a probe are one in each layer.
void GridVolume::copy_probe(std::size_t index, GLuint buffer, std::uint64_t offset_bytes) const {
  const Functions& gl = device_.gl;
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_3D, texture_.name());
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  set_pixel_store(gl, {});
  const auto& counts = grid_.counts;
  const std::size_t x = index % counts[0], y = index / counts[0] % counts[1],
                    z = index / counts[0] / counts[1];
  for (std::uint32_t layer = 0; layer < texels_of(form_); ++layer)
    gl.TexSubImage3D(
        GL_TEXTURE_3D, 0, GLint(x), GLint(y), GLint(layer * counts[2] + z), 1, 1, 1, GL_RGBA, GL_FLOAT,
        reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset_bytes + layer * 4 * sizeof(float))));
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

}  // namespace nook::gl
