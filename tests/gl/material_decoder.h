// Decodes samples of a material on the GPU, through the GLSL that a host gets, one pixel a sample.
#pragma once

#include <glad/gl.h>
#include <nook/nook_gl.h>

#include <vector>

#include "platform/platform.h"
#include "sdk/src/material/material.h"
#include "tests/gl/crowd.h"
#include "tests/gl/nnao_images.h"

namespace nook::test {

// A nook_gl, and the promise that no OpenGL error and no complaint of the driver is left at the end.
struct MaterialFixture {
  explicit MaterialFixture(platform::Context& made_in, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE);
  ~MaterialFixture();

  // Kept to the end.
  nook_material load(const material::Material& material,
                     nook_material_blocks modes = NOOK_MATERIAL_BLOCKS_NONE, int whole_light_modes = 4);
  // max_layers 0: the context's own.
  nook_gl_upload upload(nook_material material, int max_layers = 0);

  platform::Context& context;
  CountedContext host;
  nook_gl gl;
  std::vector<nook_material> materials;
  std::vector<nook_gl_upload> uploads;
};

nook_material_info info_of(nook_material material);
nook_gl_upload_info info_of(nook_gl_upload material);

// A pixel that reads one mipmap level.
struct LevelPixel {
  float uv[2];
  float level;
  float view[3];
  float light[3];
};
std::vector<nook_material_pixel> round_pixels(const std::vector<LevelPixel>& of,
                                              const nook_material_info& info);

struct GpuValue {
  nook_material_value value{};
  // Texels fetched, counted while the shader ran.
  float decode_fetches = 0, light_fetches = 0, occlusion_fetches = 0;
};

class MaterialDecoder {
 public:
  // is_anisotropic: the program has the functions with several fetches too, which drivers take long to
  // compile.
  MaterialDecoder(const GladGLContext& gl, nook_gl_upload material, nook_material_info info,
                  bool is_anisotropic = false);
  ~MaterialDecoder();
  MaterialDecoder(const MaterialDecoder&) = delete;
  MaterialDecoder& operator=(const MaterialDecoder&) = delete;

  std::vector<GpuValue> decode(const std::vector<LevelPixel>& samples) const;
  // With that many fetches along each pixel of an anisotropic decoder; 0 is the isotropic form.
  std::vector<GpuValue> decode(const std::vector<nook_material_pixel>& pixels, int fetches) const;

 private:
  // Texture coordinates, sides, views and lights, four numbers of each for a pixel.
  std::vector<GpuValue> draw(std::vector<float> (&numbers)[4], std::size_t count, int fetches) const;

  const GladGLContext& gl_;
  nook_material_info info_;
  std::vector<nook_gl_upload_texture> textures_;
  GLuint program_ = 0;
};

}  // namespace nook::test
