#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/core/checks.h"

using namespace nook;

namespace {

void check(const nook_gl_desc& desc) {
  need(reinterpret_cast<const void*>(desc.get_proc), "desc.get_proc");
  switch (desc.max_tier) {
    case NOOK_GL_TIER_BEST:
    case NOOK_GL_TIER_33:
    case NOOK_GL_TIER_43:
    case NOOK_GL_TIER_ES30:
    case NOOK_GL_TIER_ES31:
      break;
    default:
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.max_tier is unknown (got %d, need 0, 33, 43, 300 or 310)", desc.max_tier);
  }
  check_known("desc.state_mode", desc.state_mode, NOOK_GL_STATE_HOST);
  check_switch("desc.debug", desc.debug);
}

const char* text_of(const GLubyte* text) {
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

}  // namespace

nook_gl_s::nook_gl_s(nook_context_s* made_by, const nook_gl_desc& desc)
    : device(*made_by, desc),
      version(text_of(device.gl.GetString(GL_VERSION)), device.memory),
      renderer(text_of(device.gl.GetString(GL_RENDERER)), device.memory) {
  device.report_host_errors();
  guarded([&] {
    characters.emplace(device);
    device.check("making shaders and buffers");
  });
}

nook_result nook_gl_create(nook_context context, const nook_gl_desc* desc, nook_gl* out) {
  return api::enter("nook_gl_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_gl_desc known = read_descriptor(desc);
    check(known);
    *out = Owned<nook_gl_s>::make(context->memory(), Ref<nook_context_s>::share(context), context, known)
               .detach();
  });
}

void nook_gl_destroy(nook_gl* gl) {
  if (!gl || !*gl) return;
  (*gl)->release();
  *gl = nullptr;
}

nook_result nook_gl_context_lost(nook_gl gl) {
  return api::enter("nook_gl_context_lost", [&] {
    need(gl, "gl");
    gl->device.lost = true;
    gl->characters.reset();
  });
}

nook_result nook_gl_describe(nook_gl gl, nook_gl_info* info) {
  return api::enter("nook_gl_describe", [&] {
    need(gl, "gl");
    nook_gl_info known{};
    known.tier = gl::tier_of(gl->device.gl);
    known.version = gl->version.c_str();
    known.renderer = gl->renderer.c_str();
    known.buffer_bytes = gl->device.buffer_bytes;
    known.ao_bytes = gl->device.ao_bytes;
    write_info(info, known);
  });
}
