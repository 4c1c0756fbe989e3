// The compute path draws what the fragment path draws, is taken where OpenGL has it, and is refused by name
// where not.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/abi/growing_struct.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

bool message_has(const std::string& part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part.c_str()) != nullptr;
}

struct Setting {
  nnao::NetworkForm form = nnao::NetworkForm::horizon;
  int half = 0, taps = 16;
};

// A frame of a picture that lies in a part of an image.
ScreenFrame part_of(const Camera& camera, const Picture& picture, const Place& place, GLuint depth) {
  ScreenFrame frame = frame_desc(camera, place.width, place.height, depth, 0, 0.5f);
  frame.viewport[0] = place.x;
  frame.viewport[1] = place.y;
  frame.viewport[2] = int(picture.width);
  frame.viewport[3] = int(picture.height);
  return frame;
}

// The same pass on both paths.
struct BothPaths : NnaoFixture {
  explicit BothPaths(platform::Context& made_in, int max_width = 96, int max_height = 64)
      : NnaoFixture(made_in), width(max_width), height(max_height) {}
  ~BothPaths() {
    for (nook_nnao& pass : on_path) nook_nnao_destroy(&pass);
  }

  void make(const Setting& setting) {
    const nnao::Network network = mild_network(setting.form);
    PassDesc desc = pass_desc(width, height);
    desc.taps = setting.taps;
    desc.half_resolution = setting.half;
    for (const nook_nnao_path path : {NOOK_NNAO_PATH_FRAGMENT, NOOK_NNAO_PATH_COMPUTE}) {
      nook_nnao& pass = on_path[path == NOOK_NNAO_PATH_COMPUTE];
      nook_nnao_destroy(&pass);
      desc.debug.path = path;
      pass = create_pass(gl, desc, network);
      REQUIRE(info_of(pass).compute == int(path == NOOK_NNAO_PATH_COMPUTE));
    }
  }

  // The whole own texture, what lies outside the viewport too.
  std::vector<float> own(nook_nnao pass) { return own_ao(context.gl(), pass, width, height); }

  // Both ran through the same expressions. Where the compiler of a driver contracts them in another way, a
  // step of 8 bits may turn, and a tap on the border of two texels may land on either side.
  void check_same(const std::vector<float>& fragment, const std::vector<float>& compute) {
    if (context.renderer().find("llvmpipe") != std::string::npos)
      CHECK((fragment == compute));
    else
      CHECK(difference(fragment, compute, 1.1f / 255).beyond <= 0.01f);
  }
  // A frame on both, with a picture in it.
  void check_frame(const ScreenFrame& frame) {
    for (nook_nnao pass : on_path) NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    const std::vector<float> fragment = own(on_path[0]);
    check_same(fragment, own(on_path[1]));
    const auto [low, high] = std::minmax_element(fragment.begin(), fragment.end());
    if (frame.width > 16) CHECK(*high - *low > 0.1f);
  }
  void check_projections() {
    for (const Camera& camera : cameras(80.0f / 45)) {
      INFO(camera.name);
      const Picture picture = look(camera, still_life(), 80, 45);
      const GLuint depth = depth_of(camera, picture);
      check_frame(frame_desc(camera, 80, 45, depth, normals_of(picture), 1.2f));
      check_frame(frame_desc(camera, 80, 45, depth, 0, 0.4f));
    }
  }
  void check_sizes() {
    // From one pixel past a group of 8 x 8 to less than one group.
    for (const auto& [w, h] : {std::pair{65, 33}, {64, 32}, {63, 31}, {7, 9}, {1, 17}, {1, 1}})
      for (const nook_nnao_view view : {NOOK_NNAO_VIEW_AO, NOOK_NNAO_VIEW_RAW}) {
        INFO(w << " x " << h << ", view " << view);
        const Camera camera = plain_camera(float(w) / float(h));
        const Picture picture = look(camera, still_life(), std::uint32_t(w), std::uint32_t(h));
        ScreenFrame frame = frame_desc(camera, w, h, depth_of(camera, picture), 0, 0.8f);
        frame.debug.show = view;
        check_frame(frame);
      }
  }
  // Into a part of an image, whatever its format.
  void check_multiplied() {
    const Camera camera = plain_camera(1.5f);
    const Picture picture = look(camera, still_life(), 45, 30);
    const Place place{64, 50, 7, 11};
    const GLuint depth = textures.floats(GL_DEPTH_COMPONENT32F, 1, place.width, place.height,
                                         placed(stored_depth(camera, picture), 1, picture, place, 0.3f));
    const std::vector<float> grey(std::size_t(place.width) * place.height * 4, 0.7f);
    for (const GLint format : {GL_RGBA16F, GL_SRGB8_ALPHA8}) {
      INFO("format " << format);
      std::vector<float> found[2];
      for (int path = 0; path < 2; ++path) {
        const GLuint target = textures.floats(format, 4, place.width, place.height, grey);
        ScreenFrame frame = part_of(camera, picture, place, depth);
        frame.target = NOOK_TARGET_TEXTURE;
        frame.target_name = target;
        frame.blend = NOOK_BLEND_MULTIPLY;
        NOOK_OK_OR_FAIL(nook_nnao_render(on_path[path], &frame, &frame));
        found[path] = read_texture(context.gl(), target, place.width, place.height, 4);
      }
      check_same(found[0], found[1]);
      // Something was multiplied, and nothing outside the viewport.
      CHECK(std::ranges::min(found[1]) < 0.6f);
      CHECK(std::abs(found[1][0] - 0.7f) < 0.003f);  // half a step of 8 bits
    }
  }

  int width, height;
  nook_nnao on_path[2] = {};
};

}  // namespace

TEST_CASE("nnao: both paths give the same AO") {
  NOOK_NEED_CONTEXT(context);
  if (paths_of(context).size() < 2) return;
  for (const int half : {0, 1}) {
    BothPaths both(context);
    both.make({nnao::NetworkForm::horizon, half});
    INFO("half " << half);
    both.check_projections();
    both.check_sizes();
    both.check_multiplied();
  }
}

TEST_CASE("nnao: both paths give the same AO with other taps and the paper's form") {
  NOOK_NEED_CONTEXT(context);
  if (paths_of(context).size() < 2) return;
  for (const Setting& setting :
       {Setting{nnao::NetworkForm::horizon, 0, 64}, Setting{nnao::NetworkForm::paper, 1, 32}}) {
    BothPaths both(context);
    both.make(setting);
    INFO("form " << int(setting.form) << ", taps " << setting.taps);
    both.check_projections();
  }
}

TEST_CASE("nnao: the pass's own texture changes only inside the viewport") {
  NOOK_NEED_CONTEXT(context);
  const Camera camera = plain_camera(1.5f);
  const Picture picture = look(camera, still_life(), 30, 20);
  const nnao::Network network = mild_network(nnao::NetworkForm::horizon);
  for (const nook_nnao_path path : paths_of(context))
    for (const int half : {0, 1}) {
      NnaoFixture fixture(context);
      PassDesc desc = pass_desc(64, 50);
      desc.taps = 16;
      desc.half_resolution = half;
      desc.debug.path = path;
      nook_nnao pass = create_pass(fixture.gl, desc, network);
      const auto draw = [&](const Place& at) {
        const GLuint depth =
            fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, at.width, at.height,
                                    placed(stored_depth(camera, picture), 1, picture, at, 0.3f));
        const ScreenFrame frame = part_of(camera, picture, at, depth);
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        return own_ao(context.gl(), pass, 64, 50);
      };
      // Split screen: two views that do not touch each other.
      const std::vector<float> first = draw({64, 50, 0, 0}), second = draw({64, 50, 33, 25});
      std::vector<float> wanted(std::size_t(64) * 50, 1.0f);
      bool moved = false;
      for (std::size_t y = 0; y < 20; ++y)
        for (std::size_t x = 0; x < 30; ++x) {
          const float ao = first[y * 64 + x];
          wanted[y * 64 + x] = wanted[(y + 25) * 64 + x + 33] = ao;
          moved |= ao < 0.9f;
        }
      INFO("path " << path << ", half " << half);
      CHECK(moved);
      CHECK((second == wanted));
      nook_nnao_destroy(&pass);
    }
}

TEST_CASE("nnao: compute is taken where OpenGL has it, and refused with a reason where not") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  const bool has_compute = paths_of(context).size() > 1;
  const auto run = [&](Trace& trace, int max_tier, nook_nnao_path asked, nook_nnao_path got,
                       const char* message) {
    nook_gl gl = create_gl(host.handle, Trace::loader, &trace, max_tier);
    PassDesc desc = pass_desc(16, 16);
    desc.debug.path = asked;
    nook_nnao pass = nullptr;
    if (message) {
      CHECK(nook_nnao_create(gl, &desc, &pass) == NOOK_ERROR_UNSUPPORTED);
      CHECK(pass == nullptr);
      CHECK(message_has(std::string("nook_nnao_create: debug.path needs compute shaders (") + message));
    } else {
      NOOK_OK_OR_FAIL(nook_nnao_create(gl, &desc, &pass));
      CHECK(info_of(pass).compute == int(got == NOOK_NNAO_PATH_COMPUTE));
      // Hosts of the first release end before the path.
      check_info<nook_nnao_info>([&](nook_nnao_info* info) { return nook_nnao_describe(pass, info); });
    }
    nook_nnao_destroy(&pass);
    nook_gl_destroy(&gl);
  };
  // On OpenGL ES the compute path has to write four bytes for each AO: it is taken on request alone.
  const bool es = context.is_es();
  const auto best = has_compute && !es ? NOOK_NNAO_PATH_COMPUTE : NOOK_NNAO_PATH_FRAGMENT;
  const auto compute = has_compute ? NOOK_NNAO_PATH_COMPUTE : NOOK_NNAO_PATH_FRAGMENT;
  const std::string too_old =
      es ? "got OpenGL ES 3.0, need 3.1 or newer)" : "got OpenGL 3.3, need 4.3 or newer)";
  const std::string limited = es ? "got tier 300 on OpenGL ES 3." : "got tier 33 on OpenGL 4.";
  const std::string no_images =
      std::string("get_proc did not return \"glBindImageTexture\" on OpenGL ") + (es ? "ES 3." : "4.");
  const auto fragment = NOOK_NNAO_PATH_FRAGMENT;
  {
    Trace trace(context);
    run(trace, 0, NOOK_NNAO_PATH_AUTOMATIC, best, nullptr);
    run(trace, 0, NOOK_NNAO_PATH_FRAGMENT, fragment, nullptr);
    run(trace, 0, NOOK_NNAO_PATH_COMPUTE, compute, has_compute ? nullptr : too_old.c_str());
    run(trace, 33, NOOK_NNAO_PATH_AUTOMATIC, fragment, nullptr);
    run(trace, 33, NOOK_NNAO_PATH_COMPUTE, fragment, has_compute ? limited.c_str() : too_old.c_str());
  }
  if (!has_compute) return;
  Trace trace(context);
  trace.hidden.insert("glBindImageTexture");
  run(trace, 0, NOOK_NNAO_PATH_AUTOMATIC, fragment, nullptr);
  run(trace, 0, NOOK_NNAO_PATH_COMPUTE, fragment, no_images.c_str());
}
