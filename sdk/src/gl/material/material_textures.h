// Uploads a material to texture arrays, and uploads the coordinate texture that spreads a material over a
// plane. Also returns the GLSL that reads these textures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/object.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::gl {

class MaterialTextures {
 public:
  // The number of samplers that OpenGL 3.3 guarantees in a fragment shader.
  static constexpr std::size_t max_textures = 16;

  struct Texture {
    Object object;
    char uniform[40] = "";
  };

  // max_layers is the maximum number of layers in one array; 0 means the limit of this OpenGL context.
  // Changes the state of the user `materials` in touched_state.h, so the caller must hold a StateGuard.
  // Throws Failure.
  MaterialTextures(Device& device, const material::MaterialTables& tables, std::uint32_t max_layers);

  const Vector<Texture>& textures() const { return textures_; }
  const String& source() const { return source_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  void add_features(Device& device, const material::NeuralTables& tables);
  // Uploads the light map, the relief and the tensor.
  void add_btf(Device& device, const material::MaterialTables& tables, std::uint32_t max_layers);
  void add_tensor(Device& device, const material::TensorTables& tables, const char* name,
                  std::uint32_t max_layers);

  Vector<Texture> textures_;
  String source_;
  std::uint64_t bytes_ = 0;
};

class CoordinateTexture {
 public:
  // Changes the state of the user `materials` in touched_state.h, so the caller must hold a StateGuard.
  // Throws Failure.
  CoordinateTexture(Device& device, const synthesis::Coordinates& coordinates);

  GLuint name() const { return texture_.name(); }
  std::uint64_t bytes() const { return bytes_; }
  const String& source() const { return source_; }

 private:
  Object texture_;
  String source_;
  std::uint64_t bytes_ = 0;
};

}  // namespace nook::gl
