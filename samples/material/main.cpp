// Draws baked materials on several shapes under a moving light and view, and reports the cost.
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>

#include "platform/file_bytes.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "platform/standard_streams.h"
#include "samples/material/frames.h"
#include "samples/material/material_options.h"

namespace material {
namespace {

using Json = nlohmann::ordered_json;

// A material that is ready to be drawn.
struct Loaded {
  Loaded(const nook::Context& host, const nook::Gl& gl, const platform::Context& context,
         const std::filesystem::path& path, std::uint32_t fetches)
      : name(path.stem().string()),
        bytes(platform::read_file(path)),
        material(host, bytes.data(), bytes.size()),
        uploaded(gl, material),
        program(context.gl(), uploaded, fetches) {}

  std::string name;
  std::vector<unsigned char> bytes;
  nook::Material material;
  nook::Upload uploaded;
  MaterialProgram program;
};

Json describe(const Loaded& loaded, std::uint32_t fetches, const FrameTimes& times) {
  const nook_material_info info = loaded.material.info();
  const std::uint32_t further = fetches > 1 ? fetches - 1 : 0;
  return {{"material", loaded.name},
          {"clusters", info.btf.clusters},
          {"mixture", info.btf.mixture},
          {"terms", info.btf.terms},
          {"bytes", info.compressed_bytes},
          {"view_map_bytes", info.view_map_bytes},
          {"texture_bytes", loaded.uploaded.info().bytes},
          {"textures", loaded.uploaded.info().texture_count},
          {"fetches_along", fetches},
          {"decode_fetches", info.decode_fetches + further * info.further_decode_fetches},
          {"decode_multiply_adds", info.decode_multiply_adds},
          {"light_fetches", info.light_fetches},
          {"light_multiply_adds", info.light_multiply_adds},
          {"occlusion_fetches", info.occlusion_fetches + further * info.further_occlusion_fetches},
          {"occlusion_multiply_adds", info.occlusion_multiply_adds},
          {"ms", times.ms},
          {"cpu_ms", times.cpu_ms}};
}

// Returns when the window is closed. One turn of the light takes ten seconds.
void run_window(const Stage& stage, const MaterialProgram& program) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  while (!stage.context.should_close()) {
    const float seconds = std::chrono::duration<float>(Clock::now() - begin).count();
    draw_frame(stage, program, view_at(0.1f * seconds, stage.aspect), true);
    int width = 0, height = 0;
    stage.context.size(&width, &height);
    stage.target.show(0, width, height);
    stage.context.present();
  }
}

std::unique_ptr<platform::Context> create_context(const Options& o) {
  platform::ContextRequest request;
  request.kind = o.context;
  request.width = o.width_px;
  request.height = o.height_px;
  request.major = request.minor = 3;
  request.title = "Nook materials";
  return platform::create_context(request);
}

void run(const Options& o) {
  const std::unique_ptr<platform::Context> context = create_context(o);
  const nook::Context host;
  nook_gl_desc desc = nook::gl_desc();
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = context.get();
  const nook::Gl gl(host, desc);
  std::vector<Mesh> meshes;
  for (const Shape& shape : make_shapes(o.tile_m)) meshes.emplace_back(context->gl(), shape);
  const platform::RenderTarget target(*context, o.width_px, o.height_px);
  const Stage stage{*context, meshes, target, float(o.width_px) / float(o.height_px), o.is_one_sided};
  if (o.frames == 0) {
    run_window(stage, Loaded(host, gl, *context, o.files[0], o.fetches).program);
    return;
  }
  std::filesystem::create_directories(o.out);
  Json report{{"renderer", context->renderer()},
              {"version", context->version()},
              {"width", o.width_px},
              {"height", o.height_px},
              {"rows", Json::array()}};
  platform::ProgressBar bar(o.quiet);
  for (const std::filesystem::path& path : o.files) {
    const Loaded loaded(host, gl, *context, path, o.fetches);
    const FrameTimes times =
        draw_frames(stage, loaded.program, {o.frames, o.out, loaded.name},
                    [&](std::uint32_t done) { bar.show(loaded.name, "pictures", done, o.frames); });
    report["rows"].push_back(describe(loaded, o.fetches, times));
  }
  platform::OutputFile(o.report).commit(report.dump(2) + "\n");
  std::printf("pictures: %s\nreport:   %s\n", std::filesystem::absolute(o.out).c_str(),
              std::filesystem::absolute(o.report).c_str());
}

}  // namespace
}  // namespace material

int main(int argc, char** argv) {
  open_closed_streams();
  material::Options options;
  int exit_code = 0;
  if (!material::parse_options(argc, argv, options, exit_code)) return exit_code;
  try {
    material::run(options);
    return 0;
  } catch (const nook::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return e.result() == NOOK_ERROR_BAD_FILE || e.result() == NOOK_ERROR_FILE_VERSION ? 3 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
