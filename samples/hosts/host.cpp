#include "samples/hosts/host.h"

#include <glad/gl.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "platform/platform.h"
#include "platform/standard_streams.h"

// Declared as in GL/glx.h. That header includes X11 headers, which define Success and other words as macros.
extern "C" void (*glXGetProcAddressARB(const GLubyte* name))();

namespace hosts {
namespace {

struct Errors {
  int count = 0;
  std::string first;
} errors;

void GLAD_API_PTR on_message(GLenum, GLenum type, GLuint, GLenum, GLsizei, const char* text, const void*) {
  if (type != GL_DEBUG_TYPE_ERROR) return;
  if (errors.count++ == 0) errors.first = text;
}

}  // namespace

const char* const light_glsl = R"(
vec3 lit(vec3 albedo, vec3 n, float ao) {
  vec3 ambient = mix(vec3(0.62, 0.60, 0.57), vec3(0.82, 0.86, 0.92), 0.5 + 0.5 * n.y);
  float lamp = 0.35 * max(dot(n, normalize(vec3(0.5, 0.8, 0.6))), 0.0);
  return pow(albedo * (ambient * ao + lamp), vec3(1.0 / 2.2));
}
)";

nook_gl_state_mode Options::state_mode() const {
  if (state == "defaults") return NOOK_GL_STATE_DEFAULTS;
  return state == "host" ? NOOK_GL_STATE_HOST : NOOK_GL_STATE_PRESERVE;
}

bool parse_options(const char* name, int argc, char** argv, Options& o, int& exit_code) {
  CLI::App app(std::string(name) + " draws one picture of a glTF character with Nook's ambient occlusion.");
  std::string size = "640x480";
  app.add_option("character", o.character, "the rigged character, a .glb file with one skin")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("model", o.model,
                 "the model of the character, a .nook file that `nook bake character` wrote")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--clip", o.clip,
                 "name of the clip whose pose is drawn. Default: the first clip of the file");
  app.add_option("--path", o.path,
                 "where the AO comes from: gpu (default, Nook on the GPU), cpu (Nook on the CPU) or none (no "
                 "AO). nook_host_vtk also has vtk (VTK's own AO pass) and traced (VTK's ray tracer)")
      ->check(CLI::IsMember({"gpu", "cpu", "none", "vtk", "traced"}));
  app.add_option("--show", o.show,
                 "what the picture shows: lit (default), plain (lit, but the shader does not read AO) or ao")
      ->check(CLI::IsMember({"lit", "plain", "ao"}));
  app.add_option("--state", o.state,
                 "how Nook treats the OpenGL state of the host (nook_gl_state_mode). Default: preserve")
      ->check(CLI::IsMember({"preserve", "defaults", "host"}));
  app.add_flag("--orthographic", o.orthographic, "use a parallel projection; only in nook_host_vtk");
  app.add_option("--size", size, "size of the picture in pixels, WIDTHxHEIGHT. Default: 640x480");
  app.add_option("--out", o.out, "write the picture to this .png file")->required();
  try {
    app.parse(argc, argv);
    char rest = 0;
    if (std::sscanf(size.c_str(), "%dx%d%c", &o.width_px, &o.height_px, &rest) != 2 || o.width_px < 16 ||
        o.height_px < 16 || o.width_px > 4096 || o.height_px > 4096)
      throw CLI::ValidationError("--size", "got '" + size + "', need WIDTHxHEIGHT from 16x16 to 4096x4096");
    return true;
  } catch (const CLI::ParseError& e) {
    exit_code = app.exit(e) == 0 ? code_after_output(0) : 2;
    return false;
  }
}

Scene::Scene(const Options& o) : file(o.character) {
  const viewer::Clip* const clip = file.find_clip(o.clip);
  pose = file.pose(clip, clip ? 0.3f * clip->duration_s : 0);
  glm::vec3 low(1e30f), high(-1e30f);
  for (const glm::vec3& p : file.skinned(pose)) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  size_m = glm::length(high - low);
  target_ws = 0.5f * (low + high);
  const float distance_m = 0.48f * size_m / std::sin(0.5f * vertical_fov_rad);
  eye_ws = target_ws + distance_m * glm::vec3(0.466f, 0.24f, 0.852f);
  near_m = 0.3f * distance_m;
  far_m = 4 * distance_m;
}

void* gl_proc(void*, const char* name) {
  return reinterpret_cast<void*>(glXGetProcAddressARB(reinterpret_cast<const GLubyte*>(name)));
}

void start_counting_gl_errors() {
  GladGLContext gl{};
  const auto load = [](void*, const char* name) {
    return reinterpret_cast<GLADapiproc>(gl_proc(nullptr, name));
  };
  if (!gladLoadGLContextUserPtr(&gl, load, nullptr) || !gl.DebugMessageCallback)
    throw std::runtime_error("the OpenGL context has no KHR_debug");
  gl.Enable(GL_DEBUG_OUTPUT);
  gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl.DebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  gl.DebugMessageCallback(on_message, nullptr);
  while (gl.GetError() != GL_NO_ERROR) {
  }
}

void finish(const char* name, const Options& o, const unsigned char* rgb) {
  platform::Image picture;
  picture.width = o.width_px;
  picture.height = o.height_px;
  picture.channels = 3;
  picture.pixels.assign(rgb, rgb + 3 * std::size_t(o.width_px) * std::size_t(o.height_px));
  platform::write_image(o.out, picture);
  nlohmann::ordered_json report{{"host", name},
                                {"path", o.path},
                                {"state", o.state},
                                {"show", o.show},
                                {"gl_errors", errors.count},
                                {"first_error", errors.first}};
  std::printf("%s\n", report.dump().c_str());
}

int run(const char* name, int argc, char** argv, void (*body)(const Options&)) {
  open_closed_streams();
  Options options;
  int exit_code = 0;
  if (!parse_options(name, argc, argv, options, exit_code)) return exit_code;
  try {
    body(options);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", name, e.what());
    return 3;
  }
}

}  // namespace hosts
