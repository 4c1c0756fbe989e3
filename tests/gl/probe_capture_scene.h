// The tests of captures share these cube maps, in host memory and in OpenGL, and the handles that captures
// need.
#pragma once

#include <nook/experimental/nook_capture.h>
#include <nook/nook_gl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <vector>

#include "sdk/src/core/light_map.h"
#include "sdk/src/probe/probe_file.h"
#include "tests/gl/crowd.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

namespace nook::test {

using nook::probe::Probes;

inline constexpr float pi = std::numbers::pi_v<float>;

template <class Handle, void (*destroy)(Handle*)>
struct Destroy {
  void operator()(Handle handle) const { destroy(&handle); }
};
using Probe = std::unique_ptr<nook_probe_s, Destroy<nook_probe, nook_probe_destroy>>;
using GlProbe = std::unique_ptr<nook_gl_upload_s, Destroy<nook_gl_upload, nook_gl_upload_destroy>>;
using Grid = std::unique_ptr<nook_gl_upload_s, Destroy<nook_gl_upload, nook_gl_upload_destroy>>;
using Capture = std::unique_ptr<nook_gl_capture_s, Destroy<nook_gl_capture, nook_gl_capture_destroy>>;
using Gl = std::unique_ptr<nook_gl_s, Destroy<nook_gl, nook_gl_destroy>>;

// A cube map in host memory.
struct Cube {
  explicit Cube(std::uint32_t face_size) : size(face_size), rgb(18 * std::size_t(size) * size) {}
  template <class Light>
  Cube(std::uint32_t face_size, Light&& light) : Cube(face_size) {
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) set(i, light(texel(i).direction));
  }
  MapView view() const { return {MapLayout::cube, size, 6 * size, rgb}; }
  MapTexel texel(std::size_t i) const {
    return map_texel(view(), std::uint32_t(i % size), std::uint32_t(i / size));
  }
  void set(std::size_t i, Vec3 light) {
    rgb[3 * i] = light.x;
    rgb[3 * i + 1] = light.y;
    rgb[3 * i + 2] = light.z;
  }

  std::uint32_t size;
  std::vector<float> rgb;
};

// Uneven light: a gradient, noise in every texel, and a few lamps.
inline Cube uneven_cube(std::uint32_t size, std::uint64_t seed) {
  Numbers numbers(seed);
  Cube cube(size, [&](Vec3 d) {
    const float r = numbers.between(0, 1), g = numbers.between(0, 1);
    return Vec3{r + 0.5f * d.y + 0.5f, g, numbers.between(0, 2)};
  });
  for (int lamp = 0; lamp < 5; ++lamp) {
    const float bright = numbers.between(5, 40);
    cube.set(cube_cell_at(numbers.direction(), size), {bright, 0.7f * bright, 0.3f * bright});
  }
  return cube;
}

// Cube maps of OpenGL that are deleted with it.
class CubeTextures {
 public:
  explicit CubeTextures(const GladGLContext& gl) : gl_(gl) {}
  ~CubeTextures() { gl_.DeleteTextures(GLsizei(names_.size()), names_.data()); }
  CubeTextures(const CubeTextures&) = delete;
  CubeTextures& operator=(const CubeTextures&) = delete;

  // The parameters stay as in a new texture, whose filter needs mipmaps that it does not have.
  GLuint make(const Cube& cube) {
    GLuint name = 0;
    gl_.GenTextures(1, &name);
    names_.push_back(name);
    fill(name, cube, 0);
    return name;
  }
  void fill(GLuint name, const Cube& cube, GLint level) {
    gl_.BindTexture(GL_TEXTURE_CUBE_MAP, name);
    const std::size_t face = std::size_t(cube.size) * cube.size;
    std::vector<float> rgba(4 * face, 1.0f);
    for (GLenum f = 0; f < 6; ++f) {
      for (std::size_t i = 0; i < face; ++i) std::copy_n(&cube.rgb[3 * (f * face + i)], 3, &rgba[4 * i]);
      gl_.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + f, level, GL_RGBA32F, GLsizei(cube.size),
                     GLsizei(cube.size), 0, GL_RGBA, GL_FLOAT, rgba.data());
    }
    gl_.BindTexture(GL_TEXTURE_CUBE_MAP, 0);
  }

 private:
  const GladGLContext& gl_;
  std::vector<GLuint> names_;
};

inline Probes black_grid(const probe::Basis& basis, std::array<std::uint32_t, 3> counts = {1, 1, 1}) {
  Probes probes;
  probes.basis = basis;
  probes.grid = {counts, {0, 0, 0}, {1, 1, 1}};
  probes.coefficients.assign(probes.grid.size() * basis.count, Vec3{});
  return probes;
}

inline Probe loaded(nook_context context, const Probes& probes) {
  const std::vector<std::byte> file = probe::write_probes(probes, probe::Packing::float32);
  nook_probe probe = nullptr;
  NOOK_OK_OR_FAIL(nook_probe_load(context, file.data(), file.size(), &probe));
  return Probe(probe);
}

inline nook_gl_capture_desc default_desc() {
  nook_gl_capture_desc desc;
  NOOK_OK_OR_FAIL(nook_gl_capture_desc_init(&desc));
  return desc;
}

struct Fixture {
  explicit Fixture(platform::Context& context, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE)
      : gl(create_gl(host.handle, platform::Context::loader, &context, 0, mode)), cubes(context.gl()) {}
  Fixture(platform::Context& context, Trace& trace)
      : gl(create_gl(host.handle, Trace::loader, &trace, 0)), cubes(context.gl()) {}

  GlProbe upload(const Probes& probes) {
    nook_gl_upload made = nullptr;
    NOOK_OK_OR_FAIL(
        nook_gl_upload_probe(gl.get(), loaded(host.handle, probes).get(), NOOK_GL_PROBE_LOBES, &made));
    return GlProbe(made);
  }
  Grid upload_grid(const Probes& probes, nook_gl_probe_form form) {
    nook_gl_upload made = nullptr;
    NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl.get(), loaded(host.handle, probes).get(), form, &made));
    return Grid(made);
  }
  Capture capture(const nook_gl_capture_desc& desc) {
    nook_gl_capture made = nullptr;
    NOOK_OK_OR_FAIL(nook_gl_capture_create(gl.get(), &desc, &made));
    return Capture(made);
  }
  CountedContext host;
  Gl gl;
  CubeTextures cubes;
};

inline void add(const Capture& capture, std::uint32_t index, GLuint cube) {
  NOOK_OK_OR_FAIL(nook_gl_capture_add(capture.get(), index, cube, 0));
}

inline nook_gl_capture_info read(const Capture& capture, std::uint32_t index = 0) {
  nook_gl_capture_info result{};
  result.struct_size = sizeof result;
  NOOK_OK_OR_FAIL(nook_gl_capture_read(capture.get(), index, &result));
  return result;
}

inline std::vector<Vec3> solved(const Capture& capture, std::uint32_t functions, std::uint32_t index = 0) {
  nook_probe probe = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_capture_solve(capture.get(), &probe));
  const Probe owner(probe);
  std::vector<Vec3> coefficients(functions);
  NOOK_OK_OR_FAIL(nook_probe_read_coefficients(probe, index, &coefficients[0].x, functions));
  return coefficients;
}

}  // namespace nook::test
