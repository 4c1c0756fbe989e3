#include "sdk/src/gl/probe/grid_volume.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/state_guard.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe_file.h"
#include "shaders/probe/constants.h"

namespace nook::gl {
namespace {

constexpr std::size_t harmonics_count = 9;  // bands 0 to 2
using Harmonics = std::array<Vec3, harmonics_count>;

Harmonics harmonics_of(const probe::Probes& probes, std::size_t index) {
  Harmonics harmonics{};
  const std::span<const Vec3> coefficients = probes.of(index);
  if (probes.basis.kind == probe::BasisKind::harmonics) {
    std::copy_n(coefficients.begin(), std::min(coefficients.size(), harmonics.size()), harmonics.begin());
    return harmonics;
  }
  std::array<SphericalGaussian, probe::max_functions> lobes;
  probe::to_lobes(probes.basis, coefficients, lobes);
  probe::to_harmonics(std::span(lobes).first(coefficients.size()), 2, harmonics);
  return harmonics;
}

std::uint16_t half_of(float value, std::size_t probe) {
  if (!(std::abs(value) <= probe::max_half))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a coefficient of probe %zu is too large for half floats (got %g, need at most %g); scale "
                  "the light down",
                  probe, double(value), double(probe::max_half));
  return to_half(value);
}

// Writes the texels of the 3D texture. Each probe or cell has one texel in each layer.
class Writer {
 public:
  Writer(Vector<std::uint16_t>& texels, const probe::Grid& grid) : texels_(texels), grid_(grid) {}
  std::uint16_t* at(std::size_t layer, std::size_t place) {
    return texels_.data() + 4 * (layer * grid_.size() + place);
  }

 private:
  Vector<std::uint16_t>& texels_;
  const probe::Grid& grid_;
};

void write_numbers(Writer& writer, std::size_t probe, std::span<const Vec3> colours) {
  std::size_t number = 0;
  for (const Vec3 colour : colours)
    for (const float channel : {colour.x, colour.y, colour.z}) {
      writer.at(number / 4, probe)[number % 4] = half_of(channel, probe);
      ++number;
    }
}

void write_walls(Writer& writer, std::size_t layer, std::size_t place, const probe::CellWalls& walls) {
  for (const probe::WallPlane& plane : walls.plane) {
    const float numbers[4] = {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset};
    std::transform(numbers, numbers + 4, writer.at(layer++, place), to_half);
  }
  for (std::size_t side = 0; side < walls.counts.size(); ++side)
    writer.at(layer + side / 4, place)[side % 4] = to_half(float(walls.counts[side]));
}

}  // namespace

std::uint32_t texels_of(GridForm form) {
  return form == GridForm::harmonics ? NOOK_GRID_HARMONICS_TEXELS : NOOK_GRID_ZONAL_TEXELS;
}

GridTexelPlan plan_grid(const probe::Probes& probes, GridForm form) {
  GridTexelPlan plan{form, texels_of(form), probes.grid.counts};
  if (probes.walls.any()) plan.layers += NOOK_GRID_WALL_TEXELS;
  plan.size[2] *= plan.layers;
  return plan;
}

Vector<std::uint16_t> grid_texels(const probe::Probes& probes, const GridTexelPlan& plan, Memory* memory) {
  if (probes.basis.kind == probe::BasisKind::dice)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the probe consists of ambient dice; upload one that was fitted with "
                  "NOOK_PROBE_BASIS_LOBES or NOOK_PROBE_BASIS_SH");
  Vector<std::uint16_t> texels(memory);
  texels.resize(4 * plan.texels());
  Writer writer(texels, probes.grid);
  for (std::size_t p = 0; p < probes.grid.size(); ++p) {
    const Harmonics harmonics = harmonics_of(probes, p);
    if (plan.form == GridForm::harmonics)
      write_numbers(writer, p, harmonics);
    else
      write_numbers(writer, p, probe::to_zonal(harmonics));
  }
  if (!probes.walls.any()) return texels;
  const auto cells = probes.grid.cell_counts();
  const auto& counts = probes.grid.counts;
  for (std::size_t c = 0; c < probes.walls.cell.size(); ++c) {
    const std::size_t x = c % cells[0], y = c / cells[0] % cells[1], z = c / cells[0] / cells[1];
    write_walls(writer, texels_of(plan.form), (z * counts[1] + y) * counts[0] + x, probes.walls.cell[c]);
  }
  return texels;
}

std::array<float, 16> grid_frame(const probe::Probes& probes, const GridTexelPlan& plan) {
  const probe::Grid& grid = probes.grid;
  return {grid.origin_ws.x,        grid.origin_ws.y,
          grid.origin_ws.z,        probes.walls.any() ? probes.walls.bias : 0,
          1 / grid.spacing_ws.x,   1 / grid.spacing_ws.y,
          1 / grid.spacing_ws.z,   0,
          float(grid.counts[0]),   float(grid.counts[1]),
          float(grid.counts[2]),   0,
          1 / float(plan.size[0]), 1 / float(plan.size[1]),
          1 / float(plan.size[2]), 0};
}

namespace {

void check_size(const Device& device, const GridTexelPlan& plan) {
  GLint most = 0;
  device.gl.GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
  if (*std::max_element(plan.size.begin(), plan.size.end()) > std::uint32_t(std::max(most, 0)))
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the grid is too large for a 3D texture of this OpenGL (got %u x %u x %u texels, need at "
                  "most %d along each side); split the grid",
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

// A probe has one texel in each layer, so the texels are copied one by one.
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
