#include "sdk/src/gl/character/scene_lights.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/program.h"

namespace nook::gl {
namespace {

struct Texel {
  float x, y, z, w;
};

Texel texel(Vec3 v, float w) {
  return {v.x, v.y, v.z, w};
}

// Number of lobes and the ground's normal; the darkest mean radiance and 1 with a ground; ten of the light's
// bands; then two for each lobe: axis and sharpness, amplitude and the share that the ground leaves.
constexpr std::uint32_t first_lobe_texel = 12;
std::uint32_t texels_of(const InstanceLight& light) {
  return light.count ? first_lobe_texel + 2 * light.count : 0;
}

Texel* write_light(const Instance& instance, Texel* out) {
  const InstanceLight& light = instance.light;
  const LightBands& bands = light.bands;
  *out++ = {float(light.count), instance.ground.normal.x, instance.ground.normal.y, instance.ground.normal.z};
  *out++ = texel(light.darkest, instance.ground_sphere.radius > 0 ? 1.0f : 0.0f);
  *out++ = texel(bands.scalar, 0);
  for (const Vec3 v : bands.vector) *out++ = texel(v, 0);
  for (const Vec3 t : bands.tensor) *out++ = texel(t, 0);
  for (std::uint32_t i = 0; i < light.count; ++i) {
    const LightLobe& lobe = light.lobes[i];
    *out++ = texel(lobe.sharpness > 0 ? lobe.vector * (1 / lobe.sharpness) : Vec3{0, 1, 0}, lobe.sharpness);
    *out++ = texel(lobe.amplitude, lobe.above);
  }
  return out;
}

bool has_light(const Scene& scene, std::uint32_t slot) {
  return slot != Chunk::empty && scene.instances[slot].light.lobes.size() > 0;
}

// Open everywhere until the first update.
Buffer open_buffer(Device& device, std::uint64_t floats) {
  Buffer buffer(device, "nook: directional AO", floats * sizeof(float), nullptr, GL_DYNAMIC_COPY,
                BufferUse::ao);
  std::fill_n(static_cast<float*>(buffer.begin_write(floats * sizeof(float))), floats, 1.0f);
  buffer.end_write();
  return buffer;
}

void make_chunk_buffers(Device& device, Chunk& chunk) {
  const ModelBuffers& model = *chunk.model;
  if (device.gl.tier == 43)
    chunk.colours =
        Buffer(device, "nook: colours of shadows",
               std::uint64_t{chunk.capacity} * model.shadows() * sizeof(Texel) * 2, nullptr, GL_DYNAMIC_COPY);
  chunk.directional_ao = open_buffer(device, std::uint64_t{chunk.capacity} * model.file_vertices() * 3);
}

Object texture_of(Device& device, const Buffer& buffer, const char* label) {
  Object texture = Object::make(device, Object::Kind::texture);
  device.gl.ActiveTexture(GL_TEXTURE0);
  device.gl.BindTexture(GL_TEXTURE_BUFFER, texture.name());
  device.gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer.name());
  device.label(GL_TEXTURE, texture.name(), label);
  return texture;
}

// Tier 33: shadows and added occlusion by channel, two texels a key point, as many instances as fit.
void make_colour_page(Device& device, SceneBuffers& buffers) {
  std::uint64_t texels = 0, largest = 0;
  for (const Chunk& chunk : buffers.chunks) {
    if (chunk.directional_ao.name() == 0) continue;
    texels += std::uint64_t{chunk.capacity} * chunk.model->key_points() * 2;
    largest = std::max<std::uint64_t>(largest, chunk.model->key_points() * 2);
  }
  if (largest > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "a model with a light has %llu key points, a texture buffer of this OpenGL holds %u; use a "
                  "model with fewer key points",
                  static_cast<unsigned long long>(largest / 2), device.max_texels / 2);
  constexpr std::uint64_t enough = 1 << 19;
  texels = std::max(largest, std::min({texels, std::uint64_t{device.max_texels}, enough}));
  if (texels * sizeof(Texel) <= buffers.colour_page.bytes()) return;
  buffers.colour_page =
      Buffer(device, "nook: colours of shadows", texels * sizeof(Texel), nullptr, GL_STREAM_DRAW);
  buffers.colour_page_texture = texture_of(device, buffers.colour_page, "nook: colours of shadows");
}

}  // namespace

void make_light_buffers(Device& device, SceneBuffers& buffers, const Scene& scene) {
  bool any = false;
  for (Chunk& chunk : buffers.chunks) {
    const bool lit =
        std::ranges::any_of(chunk.slots, [&](std::uint32_t slot) { return has_light(scene, slot); });
    if (lit && chunk.directional_ao.name() == 0) make_chunk_buffers(device, chunk);
    any |= chunk.directional_ao.name() != 0;
  }
  if (!any) return;
  if (buffers.light_texture.name() == 0) {
    buffers.lights = Buffer(device, "nook: lights", 4096, nullptr, GL_STREAM_DRAW);
    buffers.light_texture = texture_of(device, buffers.lights, "nook: lights");
  }
  if (device.gl.tier == 33) make_colour_page(device, buffers);
}

void notice_lights(SceneBuffers& buffers, const Scene& scene) noexcept {
  for (std::size_t slot = 0; slot < buffers.placements.size(); ++slot) {
    Placement& placement = buffers.placements[slot];
    const bool lit = scene.instances[slot].light.count > 0;
    if (lit && !placement.lit) {
      placement.evaluated = false;
      placement.evaluated_frame = 0;
    }
    placement.lit = lit;
    placement.first_light_texel = Placement::no_light;
  }
}

void upload_lights(const Device& device, SceneBuffers& buffers, const Scene& scene) {
  std::uint64_t texels = 0;
  for (const Instance& instance : scene.instances) texels += texels_of(instance.light);
  if (texels == 0) return;
  if (texels > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the lights of the scene need %llu texels, a texture buffer of this OpenGL holds %u; light "
                  "fewer instances or use fewer lobes",
                  static_cast<unsigned long long>(texels), device.max_texels);
  auto* const memory = static_cast<Texel*>(buffers.lights.begin_write(texels * sizeof(Texel)));
  Texel* next = memory;
  for (std::size_t slot = 0; slot < buffers.placements.size(); ++slot) {
    const Instance& instance = scene.instances[slot];
    if (instance.light.count == 0) continue;
    buffers.placements[slot].first_light_texel = static_cast<std::uint32_t>(next - memory);
    next = write_light(instance, next);
  }
  buffers.lights.end_write();
}

const char* scene_light_glsl() {
  return embedded_text("character/host.glsl");
}

}  // namespace nook::gl
