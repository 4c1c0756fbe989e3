// The stages as data: run in plain OpenGL by nothing but what nook_stages.h gives, they draw what the
// pass draws; every text compiles for Vulkan; bad input.
#include <nook/experimental/nook_stages.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "platform/program.h"
#include "sdk/src/nnao/network_file.h"
#include "tests/abi/growing_struct.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/nnao_stage_renderer.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 61, height = 43;

bool message_has(const char* part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part) != nullptr;
}

struct Settings {
  const char* name;
  std::function<void(PassDesc&)> change;
};
const Settings all_settings[] = {
    {"default", [](PassDesc&) {}},
    {"fast", [](PassDesc& d) { d.half_resolution = 1; }},
    {"best", [](PassDesc& d) { d.taps = 32; }},
    {"no filter", [](PassDesc& d) { d.blur = 0; }},
    {"two filters", [](PassDesc& d) { d.blur = 2; }},
    {"two filters at half resolution", [](PassDesc& d) { d.blur = 2, d.half_resolution = 1; }},
    {"bent normals", [](PassDesc& d) { d.bent_normals = 1; }},
    {"bent normals at half resolution", [](PassDesc& d) { d.bent_normals = d.half_resolution = 1; }},
    {"means over frames", [](PassDesc& d) { d.max_history_frames = 4; }},
    {"means over frames at half resolution",
     [](PassDesc& d) { d.max_history_frames = 8, d.half_resolution = 1; }},
    {"two eyes", [](PassDesc& d) { d.views = 2; }},
    {"two eyes at half resolution, means over frames",
     [](PassDesc& d) { d.views = 2, d.max_history_frames = 4, d.half_resolution = 1; }},
    {"samples", [](PassDesc& d) { d.depth_samples = 4; }},
    {"nearest sample at half resolution",
     [](PassDesc& d) {
       d.depth_samples = 8, d.debug.depth_sample = NOOK_NNAO_SAMPLE_NEAREST, d.half_resolution = 1;
     }},
    {"samples of normals, means over frames",
     [](PassDesc& d) { d.depth_samples = d.normal_samples = d.max_history_frames = 4; }},
    {"two eyes of samples at half resolution",
     [](PassDesc& d) { d.views = 2, d.depth_samples = d.normal_samples = 4, d.half_resolution = 1; }},
};

nook_nnao_stages make_stages(nook_context context, const PassDesc& desc) {
  nook_nnao_stages stages = nullptr;
  NOOK_OK_OR_FAIL(nook_nnao_stages_create(context, &desc, &stages));
  return stages;
}

void compare(platform::Context& context, const Settings& settings) {
  NnaoFixture fixture(context);
  const GladGLContext& gl = context.gl();
  Textures& textures = fixture.textures;
  PassDesc desc = pass_desc(width, height);
  settings.change(desc);
  GLint most = 0;
  gl.GetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &most);
  if (desc.depth_samples > most) return;
  const int channels = desc.bent_normals ? 4 : 1;
  const bool layers = desc.views > 0, samples = desc.depth_samples > 0;
  const GLenum target = layers ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  nook_nnao pass = create_pass(fixture.gl, desc);
  nook_nnao_stages stages = make_stages(fixture.host.handle, desc);
  std::vector<std::unique_ptr<StageRenderer>> renderers;  // of each layer
  for (int layer = 0; layer < std::max(desc.views, 1); ++layer)
    renderers.push_back(std::make_unique<StageRenderer>(gl, stages));
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const std::vector<float> stored = stored_depth(camera, picture), normal_values = flat(picture.normal);
  const auto image = [&](GLint format, int count, const std::vector<float>& values) {
    return nearest(gl, target,
                   layers ? textures.array(format, count, width, height, {values, values})
                          : textures.floats(format, count, width, height, values));
  };
  const auto sampled = [&](SampledImage kind, const std::vector<float>& values) {
    const std::vector<std::vector<float>> of_layer(std::size_t(desc.depth_samples), values);
    return layers ? textures.sample_array(kind, width, height, {of_layer, of_layer})
                  : textures.samples(kind, width, height, of_layer);
  };
  const GLenum sampled_target = layers ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_MULTISAMPLE;
  const GLuint depth =
      samples ? sampled(SampledImage::depth, stored) : image(GL_DEPTH_COMPONENT32F, 1, stored);
  const GLuint normals = desc.normal_samples ? sampled(SampledImage::colours, halved_range(normal_values))
                                             : image(GL_RGB32F, 3, normal_values);
  // Every third pixel is a surface of a layer that stands apart.
  std::vector<float> layer_values(width * height * 2, 0.4f);
  for (std::size_t i = 1; i < layer_values.size(); i += 6) layer_values[i] = 0.8f;
  const GLuint layer_image = image(GL_RG32F, 2, layer_values);
  const GLuint motion = image(GL_RG32F, 2, std::vector<float>(width * height * 2, 0.3f));
  float projections[32];
  for (int i = 0; i < 32; ++i) projections[i] = camera.projection[i % 16] + (i == 24 ? 0.1f : 0.0f);
  std::vector<ScreenFrame> frames;
  for (int i = 0; i < 4; ++i) {
    ScreenFrame frame = frame_desc(camera, width, height, depth, i % 2 ? normals : 0, 0.6f);
    if (layers) frame.view_projections = projections;
    if (desc.normal_samples) frame.normal_scale = 2, frame.normal_bias = -1;
    // Each step moves the view by another 0.01 m, of both eyes.
    frame.view[12] = -0.005f * float(i * (i + 1));
    if (i == 1) frame.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE, frame.gbuffer_ao_texture = layer_image;
    if (i == 2) frame.gbuffer_ao = NOOK_GBUFFER_AO_MIN, frame.gbuffer_ao_texture = layer_image;
    if (i >= 2) frame.motion_vectors = motion;
    if (i == 3) frame.radius_kind = NOOK_NNAO_RADIUS_SCREEN, frame.radius = 0.1f, frame.intensity = 2;
    if (i == 3 && !desc.max_history_frames) {
      frame.viewport[0] = 5, frame.viewport[1] = 3, frame.viewport[2] = 41, frame.viewport[3] = 33;
    }
    frames.push_back(frame);
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const ScreenFrame& frame = frames[i];
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    for (std::size_t layer = 0; layer < renderers.size(); ++layer) {
      renderers[layer]->draw(
          frame, i > 0 ? &frames[i - 1] : nullptr, std::uint32_t(i), std::uint32_t(layer),
          {{NOOK_NNAO_IMAGE_HOST_DEPTH, {samples ? sampled_target : target, depth}},
           {NOOK_NNAO_IMAGE_HOST_NORMAL, {desc.normal_samples ? sampled_target : target, normals}},
           {NOOK_NNAO_IMAGE_HOST_GBUFFER_AO, {target, layer_image}},
           {NOOK_NNAO_IMAGE_HOST_MOTION_VECTORS, {target, motion}}});
      const std::vector<float> wanted =
          read_texture(gl, info_of(pass).texture, width, height, channels, layers ? int(layer) : -1);
      const std::vector<float> found = read_texture(gl, renderers[layer]->target(), width, height, channels);
      INFO(settings.name << ", frame " << i << ", layer " << layer);
      const ScreenFrame& f = frame;
      // Outside its viewport each target keeps what it had.
      std::size_t off = 0;
      for (int y = f.viewport[1]; y < f.viewport[1] + (f.viewport[3] ? f.viewport[3] : height); ++y)
        for (int x = f.viewport[0] * channels;
             x < (f.viewport[0] + (f.viewport[2] ? f.viewport[2] : width)) * channels; ++x) {
          const std::size_t at = std::size_t(y) * width * std::size_t(channels) + std::size_t(x);
          off += std::abs(found[at] - wanted[at]) > 1.1f / 255;
        }
      // The compiler of a driver may contract the same expressions in another way in a program of another
      // version: a tap on the border of two texels then goes the other way.
      CHECK(off <= std::size_t(width * height) / 1000);
    }
  }
  nook_nnao_stages_destroy(&stages);
  nook_nnao_destroy(&pass);
}

}  // namespace

TEST_CASE("nnao: the stages as data draw what the pass draws") {
  NOOK_NEED_CONTEXT(context);
  if (context.is_es() || version_of(context) < 45) {
    std::printf("the texts of the stages are GLSL 4.50: not run on this context\n");
    return;
  }
  for (const Settings& settings : all_settings) compare(context, settings);
}

TEST_CASE("nnao: every stage compiles as GLSL for Vulkan", "[one-context]") {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0) {
    std::printf("no glslangValidator (Debian's glslang-tools): stages are not compiled for Vulkan\n");
    return;
  }
  CountedContext host;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("nook_stages_" + std::to_string(std::random_device{}()));
  std::filesystem::create_directory(folder);
  // Many settings share a text.
  std::set<std::string> compiled;
  const auto compile = [&](const char* stage, const char* text) {
    if (!compiled.insert(text).second) return 0;
    const std::filesystem::path file = folder / (std::string("stage.") + stage);
    std::ofstream(file) << text;
    std::string command = "glslangValidator -V -o '";
    command.append(file.string()).append(".spv' '").append(file.string()).append("' > '");
    command.append(file.string()).append(".log' 2>&1");
    return std::system(command.c_str());
  };
  for (const Settings& settings : all_settings)
    for (const int taps : {9, 64}) {
      PassDesc desc = pass_desc(width, height);
      desc.taps = taps;
      settings.change(desc);
      nook_nnao_stages stages = make_stages(host.handle, desc);
      auto info = sized<nook_nnao_stages_info>();
      NOOK_OK_OR_FAIL(nook_nnao_stages_describe(stages, &info));
      if (&settings == all_settings) CHECK(compile("vert", info.vertex_shader) == 0);
      for (std::uint32_t i = 0; i < info.stage_count; ++i) {
        auto stage = sized<nook_nnao_stage_info>();
        NOOK_OK_OR_FAIL(nook_nnao_stages_describe_stage(stages, i, &stage));
        if (taps != 9 && !stage.reads_network) continue;  // only its definitions differ
        INFO(settings.name << ", " << taps << " taps, " << stage.name);
        CHECK(compile("frag", stage.fragment_shader) == 0);
      }
      nook_nnao_stages_destroy(&stages);
    }
  std::filesystem::remove_all(folder);
}

TEST_CASE("nnao: values of stages follow from the arguments alone, without memory") {
  CountedContext host;
  const PassDesc desc = pass_desc(width, height);
  nook_nnao_stages stages = make_stages(host.handle, desc);
  const ScreenFrame frame = frame_desc(plain_camera(1.4f), width, height, 0, 0, 0.5f);
  auto first = sized<nook_nnao_frame_values>(), second = first;
  const long allocations = host.allocations;
  NOOK_OK_OR_FAIL(nook_nnao_stages_frame(stages, &frame, &frame, nullptr, 3, 0, &first));
  NOOK_OK_OR_FAIL(nook_nnao_stages_frame(stages, &frame, &frame, nullptr, 3, 0, &second));
  CHECK(host.allocations == allocations);
  CHECK(std::memcmp(&first, &second, sizeof first) == 0);
  CHECK(first.viewport[2] == width);
  CHECK(first.surface_height == height);
  // depth, depth_apart, occlusion, filter_x, resolve, resolve_layered.
  const auto drawn = [&](nook_gbuffer_ao layer) {
    ScreenFrame layered = frame;
    layered.gbuffer_ao = layer;
    NOOK_OK_OR_FAIL(nook_nnao_stages_frame(stages, &layered, &layered, nullptr, 0, 0, &second));
    return second.drawn_stages;
  };
  CHECK(drawn(NOOK_GBUFFER_AO_NONE) == 0b011101);
  CHECK(drawn(NOOK_GBUFFER_AO_MIN) == 0b101101);
  CHECK(drawn(NOOK_GBUFFER_AO_EXCLUDE) == 0b101110);
  check_info<nook_nnao_frame_values>([&](nook_nnao_frame_values* values) {
    return nook_nnao_stages_frame(stages, &frame, &frame, nullptr, 0, 0, values);
  });
  nook_nnao_stages_destroy(&stages);
}

TEST_CASE("nnao: bad arguments of stages are refused with their name") {
  CountedContext host;
  PassDesc desc = pass_desc(width, height);
  desc.max_history_frames = 4;
  nook_nnao_stages stages = make_stages(host.handle, desc);
  auto stage = sized<nook_nnao_stage_info>();
  auto image = sized<nook_nnao_image_info>();
  auto values = sized<nook_nnao_frame_values>();
  CHECK(nook_nnao_stages_describe_stage(stages, 99, &stage) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("nook_nnao_stages_describe_stage: index is out of range (got 99, need less than 7)"));
  CHECK(nook_nnao_stages_describe_image(stages, 11, &image) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("image is unknown (got 11, need 0 to 10)"));
  const ScreenFrame good = frame_desc(plain_camera(1.4f), width, height, 0, 0, 0.5f);
  const auto refused = [&](const ScreenFrame& frame, const ScreenFrame* earlier, std::uint32_t layer,
                           const char* message) {
    CHECK(nook_nnao_stages_frame(stages, &frame, &frame, earlier, 0, layer, &values) ==
          NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has(message));
  };
  ScreenFrame bad = good;
  bad.radius = -1;
  refused(bad, nullptr, 0, "desc.radius");
  bad = good, bad.height = 0;
  refused(good, &bad, 0, "frame.width and frame.height");
  refused(good, nullptr, 1, "view is out of range (got 1, need less than 1)");
  bad = good, bad.width = width + 1;
  refused(bad, nullptr, 0, "frame.width");
  bad = good, bad.debug.show = NOOK_NNAO_VIEW_NORMALS;
  refused(bad, nullptr, 0, "debug.show 3");
  bad = good, bad.debug.show = NOOK_NNAO_VIEW_RAW;
  refused(bad, nullptr, 0, "debug.show 1 is not available if desc.max_history_frames is not 0 (got 4)");
  CHECK(nook_nnao_stages_frame(nullptr, &good, &good, nullptr, 0, 0, &values) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_stages_frame(stages, nullptr, &good, nullptr, 0, 0, &values) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_stages_frame(stages, &good, &good, nullptr, 0, 0, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_nnao_stages_destroy(&stages);
  nook_nnao_stages_destroy(&stages);
  nook_nnao_stages_destroy(nullptr);
  desc.taps = 10;
  CHECK(nook_nnao_stages_create(host.handle, &desc, &stages) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.taps is unknown"));
  const std::vector<std::byte> network = nnao::write_network(mild_network(nnao::NetworkForm::paper));
  desc = pass_desc(width, height);
  desc.network = network.data();
  desc.network_size = network.size();
  CHECK(nook_nnao_stages_create(host.handle, &desc, &stages) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.network has the paper's form"));
  desc.network_size = 5;
  CHECK(nook_nnao_stages_create(host.handle, &desc, &stages) == NOOK_ERROR_BAD_FILE);
  CHECK(stages == nullptr);
}

TEST_CASE("nnao: stages describe their shaders, the network and the images that they write") {
  CountedContext host;
  nook_nnao_stages stages = make_stages(host.handle, pass_desc(width, height));
  auto info = sized<nook_nnao_stages_info>();
  NOOK_OK_OR_FAIL(nook_nnao_stages_describe(stages, &info));
  CHECK(info.stage_count == 6);
  CHECK(info.network != nullptr);
  CHECK(info.network_bytes % 16 == 0);
  for (std::uint32_t i = 0; i < info.stage_count; ++i) {
    auto stage = sized<nook_nnao_stage_info>();
    auto image = sized<nook_nnao_image_info>();
    NOOK_OK_OR_FAIL(nook_nnao_stages_describe_stage(stages, i, &stage));
    NOOK_OK_OR_FAIL(nook_nnao_stages_describe_image(stages, stage.output, &image));
    CHECK(std::string_view(stage.fragment_shader).substr(0, 12) == "#version 450");
    CHECK(image.format != NOOK_NNAO_FORMAT_NONE);
    CHECK(image.width == width);
    CHECK(image.height == height);
  }
  nook_nnao_stages_destroy(&stages);
}
