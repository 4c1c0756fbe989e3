#include <nook/nook_gl_synthesis.h>

#include <optional>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/synthesis_handle.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/synthesis/coordinate_texture.h"

using namespace nook;

// The OpenGL objects outlive the handle nook_gl, because this object holds a reference to its owner.
struct nook_gl_synthesis_s : RefCounted {
  nook_gl_synthesis_s(nook_gl_s* made_by, const synthesis::Coordinates& coordinates) {
    made_by->device.report_host_errors();
    made_by->guarded(gl::materials, [&] { texture.emplace(made_by->device, coordinates); });
  }

  std::optional<gl::CoordinateTexture> texture;
};

namespace {

constexpr std::size_t first_info = offsetof(nook_gl_synthesis_info, glsl) + sizeof(const char*);

}  // namespace

nook_result nook_gl_synthesis_create(nook_gl gl, nook_synthesis synthesis, nook_gl_synthesis* out) {
  return api::enter("nook_gl_synthesis_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(synthesis, "synthesis");
    gl->device.need_alive();
    *out = Owned<nook_gl_synthesis_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl), gl,
                                            synthesis->coordinates)
               .detach();
  });
}

void nook_gl_synthesis_destroy(nook_gl_synthesis* synthesis) {
  if (!synthesis || !*synthesis) return;
  (*synthesis)->release();
  *synthesis = nullptr;
}

nook_result nook_gl_synthesis_describe(nook_gl_synthesis synthesis, nook_gl_synthesis_info* info) {
  return api::enter("nook_gl_synthesis_describe", [&] {
    need(synthesis, "synthesis");
    nook_gl_synthesis_info known{};
    known.texture = synthesis->texture->name();
    known.texture_bytes = synthesis->texture->bytes();
    known.glsl = synthesis->texture->source().c_str();
    write_info(info, first_info, known);
  });
}
