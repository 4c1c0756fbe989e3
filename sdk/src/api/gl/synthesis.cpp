#include <nook/experimental/nook_synthesis.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/upload.h"
#include "sdk/src/api/synthesis_handle.h"

using namespace nook;

nook_result nook_gl_upload_synthesis(nook_gl gl, nook_synthesis synthesis, nook_gl_upload* out) {
  return api::enter("nook_gl_upload_synthesis", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(synthesis, "synthesis");
    *out = api::make_upload<gl::CoordinateTexture>(gl, gl::materials, synthesis->coordinates);
  });
}
