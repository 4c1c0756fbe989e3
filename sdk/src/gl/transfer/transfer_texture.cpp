#include "sdk/src/gl/transfer/transfer_texture.h"

#include <cstdio>
#include <cstring>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/program.h"

namespace nook::gl {

TransferTexture::TransferTexture(Device& device, std::uint32_t light_modes, std::uint32_t vertices)
    : device_(device),
      texels_(std::uint64_t(3) * (light_modes / 4) * vertices),
      table_(device.memory),
      source_(device.memory) {
  if (texels_ > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the vectors are too large for a texture buffer of this OpenGL (%u vertices with %u light "
                  "modes are %llu texels, need at most %u); split the shape, or upload them as attributes",
                  vertices, light_modes, static_cast<unsigned long long>(texels_), device.max_texels);
  char definition[120];
  std::snprintf(definition, sizeof definition,
                "#ifndef NOOK_LIGHT_VEC4_COUNT\n#define NOOK_LIGHT_VEC4_COUNT %u\n#endif\n", light_modes / 4);
  source_ = definition;
  source_ += embedded_text("transfer/host.glsl");
  table_.reserve(device, GL_RGBA32F, texels_, "nook: radiance transfer");
  table_.write(device, texels_, [&](void* memory) { std::memset(memory, 0, texels_ * 4 * sizeof(float)); });
}

void TransferTexture::update(std::span<const float> vectors) {
  table_.write(device_, texels_,
               [&](void* memory) { std::memcpy(memory, vectors.data(), vectors.size_bytes()); });
}

}  // namespace nook::gl
