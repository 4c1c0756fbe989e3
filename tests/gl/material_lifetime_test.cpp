// Materials on the GPU as careless hosts use them: any order of destruction, refused allocations,
// limits, lost contexts.
#include <cstring>
#include <string>

#include "sdk/src/api/gl/upload.h"
#include "sdk/src/material/material_file.h"
#include "tests/gl/material_decoder.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::test;

std::vector<std::byte> nook_test_material_bytes() {
  return material::write_material(material::test::sample_material(3));
}

namespace {

// Names are small numbers handed out from 1 on, on every driver that the tests run on.
int living_textures(const GladGLContext& gl) {
  int count = 0;
  for (GLuint name = 1; name < 10000; ++name) count += gl.IsTexture(name);
  return count;
}

bool message_has(const char* part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part) != nullptr;
}

}  // namespace

TEST_CASE("material: an upload, its nook_gl, its material and its context may go in any order") {
  NOOK_NEED_CONTEXT(context);
  const int before = living_textures(context.gl());
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  for (const char* order : {"0123", "3210", "1302", "2031", "3120"}) {
    INFO(order);
    CountedContext host;
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
    nook_material loaded = nullptr;
    NOOK_OK_OR_FAIL(nook_material_load(host.handle, bytes.data(), bytes.size(), nullptr, &loaded));
    nook_gl_upload uploaded = nullptr;
    NOOK_OK_OR_FAIL(nook_gl_upload_material(gl, loaded, &uploaded));
    for (const char* step = order; *step; ++step) {
      if (*step == '0') nook_gl_upload_destroy(&uploaded);
      if (*step == '1') nook_material_destroy(&loaded);
      if (*step == '2') nook_gl_destroy(&gl);
      if (*step == '3') nook_context_destroy(&host.handle);
    }
    CHECK(living_textures(context.gl()) == before);
    CHECK(host.bytes == 0);
  }
}

TEST_CASE("material: a failed upload leaves nothing behind") {
  NOOK_NEED_CONTEXT(context);
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  CountedContext host;
  Trace trace(context);
  nook_gl gl = create_gl(host.handle, Trace::loader, &trace, 0);
  nook_material loaded = nullptr;
  NOOK_OK_OR_FAIL(nook_material_load(host.handle, bytes.data(), bytes.size(), nullptr, &loaded));
  const int before = living_textures(context.gl());
  const long long held = host.bytes;
  nook_gl_upload uploaded = nullptr;
  int refusals = 0;
  for (long n = 0; !uploaded; ++n) {
    host.refuse_after = n;
    const nook_result result = nook_gl_upload_material(gl, loaded, &uploaded);
    host.refuse_after = -1;
    if (result == NOOK_OK) break;
    ++refusals;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(living_textures(context.gl()) == before);
    CHECK(host.bytes == held);
  }
  CHECK(refusals >= 3);
  nook_gl_upload_destroy(&uploaded);

  // An OpenGL whose texture arrays have a single layer.
  std::string failure;
  try {
    uploaded = nook::api::upload_material(gl, loaded, 1);
  } catch (const Failure& refused) {
    CHECK(refused.code() == NOOK_ERROR_UNSUPPORTED);
    failure = refused.what();
  }
  CHECK(failure.find("more textures than a shader can read (got 20 with 1 layers each") != std::string::npos);
  trace.limits[GL_MAX_TEXTURE_SIZE] = 128;  // the view map has 256
  CHECK(nook_gl_upload_material(gl, loaded, &uploaded) == NOOK_ERROR_UNSUPPORTED);
  CHECK(message_has("got 256 texels, need at most 128"));
  trace.limits.clear();
  CHECK(nook_gl_upload_material(nullptr, loaded, &uploaded) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_material(gl, nullptr, &uploaded) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_material(gl, loaded, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(living_textures(context.gl()) == before);
  CHECK(host.bytes == held);
  nook_material_destroy(&loaded);
  nook_gl_destroy(&gl);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("material: blocks that a context lacks are refused, and the message names those that it has") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  Trace trace(context);
  // Creates textures of modes in blocks of a material of 8 rows, in a context that is as `trace` says.
  const auto create = [&](nook_material_blocks modes, std::uint32_t width) {
    const std::vector<std::byte> bytes =
        material::write_material(material::test::sample_material(3, {.width = width, .height = 8}));
    nook_material_desc desc;
    NOOK_OK_OR_FAIL(nook_material_desc_init(&desc));
    desc.blocks = modes;
    nook_material loaded = nullptr;
    NOOK_OK_OR_FAIL(nook_material_load(host.handle, bytes.data(), bytes.size(), &desc, &loaded));
    nook_gl gl = create_gl(host.handle, Trace::loader, &trace, 0);
    nook_gl_upload uploaded = nullptr;
    const nook_result result = nook_gl_upload_material(gl, loaded, &uploaded);
    CHECK((uploaded != nullptr) == (result == NOOK_OK));
    nook_gl_upload_destroy(&uploaded);
    nook_gl_destroy(&gl);
    nook_material_destroy(&loaded);
    return result;
  };
  const nook_material_blocks rgtc = NOOK_MATERIAL_BLOCKS_RGTC, eac = NOOK_MATERIAL_BLOCKS_EAC;
  // The oldest version, without extensions.
  constexpr unsigned num_extensions = 0x821D;
  trace.limits = {{GL_MAJOR_VERSION, 3}, {GL_MINOR_VERSION, context.is_es() ? 0 : 3}, {num_extensions, 0}};
  CHECK(create(context.is_es() ? rgtc : eac, 8) == NOOK_ERROR_UNSUPPORTED);
  CHECK(message_has(context.is_es()
                        ? "(got NOOK_MATERIAL_BLOCKS_RGTC, need NOOK_MATERIAL_BLOCKS_EAC or _NONE)"
                        : "(got NOOK_MATERIAL_BLOCKS_EAC, need NOOK_MATERIAL_BLOCKS_RGTC or _NONE)"));
  // WebGL, whose extensions are all there but enabled by the page alone.
  trace.version = "OpenGL ES 3.0 (WebGL 2.0)";
  trace.limits = {{GL_MAJOR_VERSION, 3}, {GL_MINOR_VERSION, 0}, {GL_NUM_COMPRESSED_TEXTURE_FORMATS, 0}};
  for (const nook_material_blocks modes : {rgtc, eac}) {
    CHECK(create(modes, 8) == NOOK_ERROR_UNSUPPORTED);
    CHECK(message_has("need NOOK_MATERIAL_BLOCKS_NONE)"));
  }
  trace.formats = {GL_COMPRESSED_RG_RGTC2, GL_COMPRESSED_SIGNED_RG_RGTC2};
  trace.limits[GL_NUM_COMPRESSED_TEXTURE_FORMATS] = 2;
  CHECK(create(eac, 8) == NOOK_ERROR_UNSUPPORTED);
  CHECK(create(rgtc, 6) == NOOK_ERROR_UNSUPPORTED);
  CHECK(message_has("got 6 x 8 texels, need multiples of 4"));
  if (!context.is_es()) CHECK(create(rgtc, 8) == NOOK_OK);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("material: after the OpenGL context is lost nothing calls OpenGL, and destroy works") {
  NOOK_NEED_CONTEXT(context);
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  CountedContext host;
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  nook_material loaded = nullptr;
  NOOK_OK_OR_FAIL(nook_material_load(host.handle, bytes.data(), bytes.size(), nullptr, &loaded));
  nook_gl_upload uploaded = nullptr, other = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_upload_material(gl, loaded, &uploaded));
  // Without a current context any OpenGL call would crash or be caught by the next check.
  context.clear_current();
  NOOK_OK_OR_FAIL(nook_gl_context_lost(gl));
  CHECK(nook_gl_upload_material(gl, loaded, &other) == NOOK_ERROR_GL);
  nook_gl_upload_destroy(&uploaded);
  nook_gl_destroy(&gl);
  nook_material_destroy(&loaded);
  context.make_current();
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}
