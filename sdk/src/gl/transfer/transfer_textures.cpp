#include "sdk/src/gl/transfer/transfer_textures.h"

#include <cstdio>
#include <cstring>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/transfer/lit_rows.h"

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

namespace {

void check_fits(const Device& device, std::uint64_t texels, const char* what) {
  if (texels > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the %s are too large for a texture buffer of this OpenGL (%llu texels, need at most %u); "
                  "split the shape, or upload the vectors",
                  what, static_cast<unsigned long long>(texels), device.max_texels);
}

}  // namespace

PaperTexture::PaperTexture(Device& device, const transfer::Transfer& transfer)
    : device_(device),
      light_texels_(transfer::lit_row_count(transfer) * 3 * (transfer.paper.light_modes / 4)),
      light_(device.memory),
      vertices_(device.memory),
      source_(device.memory) {
  const std::size_t numbers = transfer::vertex_number_count(transfer);
  const std::uint64_t vertex_texels = std::uint64_t{transfer.vertex_count()} * (numbers / 4);
  check_fits(device, light_texels_, "clusters' matrices");
  check_fits(device, vertex_texels, "vertices' weights");
  char definition[400];
  std::snprintf(definition, sizeof definition,
                "#ifndef NOOK_LIGHT_VEC4_COUNT\n#define NOOK_LIGHT_VEC4_COUNT %u\n#endif\n"
                "#define NOOK_TRANSFER_CLUSTERS %u\n#define NOOK_TRANSFER_VERTEX_RANK %u\n"
                "#define NOOK_TRANSFER_BANDS %u\n#define NOOK_TRANSFER_VERTEX_TEXELS %u\n",
                transfer.paper.light_modes / 4, transfer.paper.clusters, transfer.paper.vertex_rank,
                transfer.bounces * transfer::band_count, unsigned(numbers / 4));
  source_ = definition;
  source_ += embedded_text("transfer/host.glsl");
  Vector<float> weights(numbers * transfer.vertex_count(), 0.0f, device.memory);
  for (std::size_t v = 0; v < transfer.vertex_count(); ++v)
    transfer::write_vertex_numbers(transfer, v, &weights[v * numbers]);
  vertices_.replace(device, GL_RGBA32F, vertex_texels, weights.data(), "nook: weights of radiance transfer");
  light_.reserve(device, GL_RGBA32F, light_texels_, "nook: radiance transfer");
  update([](std::span<float> rows) { std::memset(rows.data(), 0, rows.size_bytes()); });
}

}  // namespace nook::gl
