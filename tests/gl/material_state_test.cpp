// The promise of nook_gl_state_mode for the upload of materials.
#include <functional>
#include <optional>

#include "sdk/src/gl/touched_state.h"
#include "tests/gl/material_decoder.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

using Check = std::function<void(Poison&, const std::function<void()>&)>;

// An upload under odd state decodes to the same as a calm one.
void walk(platform::Context& context, nook_gl_state_mode mode, const Check& check) {
  MaterialFixture fixture(context, mode);
  const nook_material loaded = fixture.load(material::test::sample_material(1));
  const nook_material_info info = info_of(loaded);
  LevelPixel sample{};
  sample.view[2] = sample.light[2] = 1;
  const auto decoded = [&](nook_gl_upload uploaded) {
    const nook_material_value value = MaterialDecoder(context.gl(), uploaded, info).decode({sample})[0].value;
    return std::vector<float>{value.radiance[0], value.radiance[1], value.radiance[2], value.occlusion};
  };
  const std::vector<float> wanted = decoded(fixture.upload(loaded));
  nook_gl_upload uploaded = nullptr;
  {
    Poison poison(context, gl::materials);
    check(poison, [&] { NOOK_OK_OR_FAIL(nook_gl_upload_material(fixture.gl, loaded, &uploaded)); });
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
  CHECK(decoded(uploaded) == wanted);
  Poison poison(context, 0);
  check(poison, [&] { nook_gl_upload_destroy(&uploaded); });
}

}  // namespace

TEST_CASE("material: PRESERVE puts all state back") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_PRESERVE, [&](Poison& poison, const std::function<void()>& call) {
    const StateValues touched = poison.touched(), untouched = poison.untouched();
    call();
    CHECK(poison.touched() == touched);
    CHECK(poison.untouched() == untouched);
  });
}

TEST_CASE("material: DEFAULTS leaves the defaults") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_DEFAULTS, [&](Poison& poison, const std::function<void()>& call) {
    const StateValues untouched = poison.untouched();
    call();
    CHECK(poison.touched() == poison.defaults());
    CHECK(poison.untouched() == untouched);
  });
}

TEST_CASE("material: HOST touches only what the list names, and works whatever it finds") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_HOST, [&](Poison& poison, const std::function<void()>& call) {
    const StateValues untouched = poison.untouched();
    call();
    CHECK(poison.untouched() == untouched);
  });
}
