// showcase: draws a stage with characters three times: without occlusion, with Nook, and ray traced. Needs no
// display. sheet.py puts the pictures together.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "platform/file_bytes.h"
#include "platform/platform.h"
#include "platform/standard_streams.h"
#include "samples/showcase/light.h"

namespace showcase {
namespace {

struct Options {
  std::filesystem::path stage, assets, models, character, model, out = "out/showcase";
  std::string shot = "whole", context = "egl";
  int width_px = 1600, height_px = 900, samples_across = 2;
  Rays rays;
};

int parse(int argc, char** argv, Options& o) {
  CLI::App app(
      "Draws a scene with characters three times: without occlusion, with Nook, and ray traced.\nGive "
      "--stage with --assets and --models, or --character and --model for the built-in street corner.");
  app.add_option("--stage", o.stage,
                 "the stage: a JSON file that lists characters, props, light and cameras, such as yard.json. "
                 "Default: the built-in street corner")
      ->check(CLI::ExistingFile);
  app.add_option("--assets", o.assets, "with --stage: folder that contains the glTF files of the stage")
      ->check(CLI::ExistingDirectory);
  app.add_option("--models", o.models,
                 "with --stage: folder that contains the baked models of its characters")
      ->check(CLI::ExistingDirectory);
  app.add_option("--character", o.character, "for the street corner: the built-in character, a .glb file")
      ->check(CLI::ExistingFile);
  app.add_option("--model", o.model,
                 "for the street corner: the baked model of the built-in character, a .nook file")
      ->check(CLI::ExistingFile);
  app.add_option("--shot", o.shot, "name of the camera of the stage. Default: whole");
  app.add_option(
      "--out", o.out,
      "write off.png, nook.png, traced.png and report.json into this folder. Default: out/showcase");
  app.add_option("--width", o.width_px, "width of a picture in pixels. Default: 1600")
      ->check(CLI::Range(16, 4096));
  app.add_option("--height", o.height_px, "height of a picture in pixels. Default: 900")
      ->check(CLI::Range(16, 4096));
  app.add_option("--samples-across", o.samples_across,
                 "number of samples along each side of a pixel. Default: 2")
      ->check(CLI::Range(1, 4));
  app.add_option("--rays", o.rays.sky, "number of rays to the sky for each sample. Default: 32")
      ->check(CLI::Range(1, 65536));
  app.add_option("--sun-rays", o.rays.sun, "number of rays to the sun for each sample. Default: 16")
      ->check(CLI::Range(1, 65536));
  app.add_option("--context", o.context,
                 std::string("how to create the OpenGL context (default egl): ") + platform::context_kinds())
      ->check(CLI::IsMember({"egl", "osmesa"}));
  try {
    app.parse(argc, argv);
    if (o.stage.empty() == (o.character.empty() || o.model.empty()))
      throw CLI::ValidationError("give --stage with --assets and --models, or --character and --model");
    return -1;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? code_after_output(0) : 2;
  }
}

// Averages the samples of each pixel, and reverses the order of the rows.
platform::Image averaged(const std::vector<glm::vec3>& samples, const Options& o) {
  platform::Image image{o.width_px, o.height_px, 3, {}};
  const int n = o.samples_across;
  for (int y = o.height_px - 1; y >= 0; --y)
    for (int x = 0; x < o.width_px; ++x) {
      glm::vec3 sum(0);
      for (int sy = 0; sy < n; ++sy)
        for (int sx = 0; sx < n; ++sx)
          sum += samples[std::size_t((y * n + sy) * o.width_px * n + x * n + sx)];
      for (int c = 0; c < 3; ++c) image.pixels.push_back(std::uint8_t(255 * sum[c] / float(n * n) + 0.5f));
    }
  return image;
}

// Mean squared differences of displayed values, for all surfaces, for actors and for props.
nlohmann::ordered_json errors(const Surfaces& surfaces, const std::vector<glm::vec3>& values,
                              const std::vector<glm::vec3>& truth) {
  double sums[2] = {0, 0}, counts[2] = {0, 0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (surfaces.pixels[i].kind == Kind::sky) continue;
    const glm::vec3 difference = values[i] - truth[i];
    const int which = surfaces.pixels[i].kind == Kind::actor;
    sums[which] += double(glm::dot(difference, difference)) / 3;
    counts[which] += 1;
  }
  return {{"mse", (sums[0] + sums[1]) / (counts[0] + counts[1])},
          {"mse_actors", sums[1] / counts[1]},
          {"mse_props", sums[0] / counts[0]},
          {"actor_samples", counts[1]},
          {"prop_samples", counts[0]}};
}

const crowd::Camera& camera_of(const Stage& stage, const std::string& shot) {
  if (const auto found = stage.shots.find(shot); found != stage.shots.end()) return found->second;
  std::string names;
  for (const auto& [name, camera] : stage.shots) names += (names.empty() ? "" : ", ") + name;
  throw std::runtime_error("showcase: the stage has no shot " + shot + "; it has " + names);
}

void run(const Options& o) {
  Stage stage =
      o.stage.empty() ? street_corner(o.character, o.model) : read_stage(o.stage, o.assets, o.models);
  stage.camera = camera_of(stage, o.shot);
  const Cast cast(stage);
  platform::ContextRequest request;
  request.kind = o.context;
  const std::unique_ptr<platform::Context> context = platform::create_context(request);
  const Surfaces surfaces =
      draw_surfaces(*context, stage, cast, o.width_px * o.samples_across, o.height_px * o.samples_across);
  const Irradiance light = light_surfaces(stage, cast, surfaces, o.rays);
  const std::vector<glm::vec3> truth = developed(stage, surfaces, light.sun, light.ray_traced);
  std::filesystem::create_directories(o.out);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const std::pair<const char*, const std::vector<glm::vec3>*> kinds[] = {{"off", &light.off},
                                                                         {"nook", &light.nook}};
  for (const auto& [name, sky] : kinds) {
    const std::vector<glm::vec3> values = developed(stage, surfaces, light.sun, *sky);
    platform::write_image(o.out / (std::string(name) + ".png"), averaged(values, o));
    nlohmann::ordered_json row = {{"picture", name}};
    row.update(errors(surfaces, values, truth));
    rows.push_back(row);
  }
  platform::write_image(o.out / "traced.png", averaged(truth, o));
  const std::string report = nlohmann::ordered_json{{"rows", rows}}.dump(2) + "\n";
  platform::write_file(o.out / "report.json", report.data(), report.size());
  std::printf("%s", report.c_str());
}

}  // namespace
}  // namespace showcase

int main(int argc, char** argv) {
  open_closed_streams();
  showcase::Options options;
  if (const int code = showcase::parse(argc, argv, options); code >= 0) return code;
  try {
    showcase::run(options);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
