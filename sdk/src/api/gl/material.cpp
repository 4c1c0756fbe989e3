#include <nook/nook_gl_material.h>

#include <optional>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/material_handle.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/material/material_textures.h"

using namespace nook;

// The OpenGL objects outlive the handle nook_gl, because this object holds a reference to its owner.
struct nook_gl_material_s : RefCounted {
  nook_gl_material_s(nook_gl_s* made_by, const material::MaterialTables& tables, std::uint32_t max_layers) {
    made_by->device.report_host_errors();
    made_by->guarded(gl::materials, [&] { textures.emplace(made_by->device, tables, max_layers); });
  }

  std::optional<gl::MaterialTextures> textures;
};

namespace {

nook_gl_material_desc default_desc() {
  nook_gl_material_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  return desc;
}
constexpr std::size_t first_desc = offsetof(nook_gl_material_desc, reserved) + sizeof(std::int32_t);
constexpr std::size_t first_info = offsetof(nook_gl_material_info, glsl) + sizeof(const char*);
constexpr std::size_t first_texture = offsetof(nook_gl_material_texture, uniform) + sizeof(const char*);

nook_gl_material_desc checked(const nook_gl_material_desc* given) {
  if (!given) return default_desc();
  const nook_gl_material_desc desc =
      read_descriptor(given, "nook_gl_material_desc_init", first_desc, default_desc());
  if (desc.max_layers < 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.max_layers is negative (got %d, need 0 or more)",
                  desc.max_layers);
  if (desc.reserved != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %d, need 0", desc.reserved);
  return desc;
}

}  // namespace

nook_result nook_gl_material_desc_init(nook_gl_material_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_gl_material_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_desc, default_desc()); });
}

nook_result nook_gl_material_create(nook_gl gl, nook_material material, const nook_gl_material_desc* desc,
                                    nook_gl_material* out) {
  return api::enter("nook_gl_material_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(material, "material");
    gl->device.need_alive();
    const nook_gl_material_desc known = checked(desc);
    *out = Owned<nook_gl_material_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl, material->tables,
                                           static_cast<std::uint32_t>(known.max_layers))
               .detach();
  });
}

void nook_gl_material_destroy(nook_gl_material* material) {
  if (!material || !*material) return;
  (*material)->release();
  *material = nullptr;
}

nook_result nook_gl_material_describe(nook_gl_material material, nook_gl_material_info* info) {
  return api::enter("nook_gl_material_describe", [&] {
    need(material, "material");
    nook_gl_material_info known{};
    known.texture_count = static_cast<std::uint32_t>(material->textures->textures().size());
    known.texture_bytes = material->textures->bytes();
    known.glsl = material->textures->source().c_str();
    write_info(info, first_info, known);
  });
}

nook_result nook_gl_material_describe_texture(nook_gl_material material, uint32_t index,
                                              nook_gl_material_texture* texture) {
  return api::enter("nook_gl_material_describe_texture", [&] {
    need(material, "material");
    const auto& textures = material->textures->textures();
    if (index >= textures.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "index is out of range (got %u, need less than %zu)", index,
                    textures.size());
    nook_gl_material_texture known{};
    known.target = GL_TEXTURE_2D_ARRAY;
    known.texture = textures[index].object.name();
    known.uniform = textures[index].uniform;
    write_info(texture, first_texture, known);
  });
}
