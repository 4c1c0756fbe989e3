#include "bakers/lab/crowd/crowd_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "platform/platform.h"
#include "platform/standard_streams.h"

namespace crowd::lab {
namespace {

std::string parse_size(const std::string& text, Options& o) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &o.width_px, &o.height_px, &rest) == 2 && o.width_px >= 16 &&
      o.height_px >= 16 && o.width_px <= 8192 && o.height_px <= 8192)
    return "";
  return "got '" + text + "', need WIDTHxHEIGHT from 16x16 to 8192x8192";
}

std::string parse_tier(const std::string& text, Options& o) {
  o.crowd.tier = text == "33" ? 33 : text == "43" ? 43 : 0;
  return "";
}

DebugView debug_view(const std::vector<std::string>& names, std::uint32_t bodies) {
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return {has("spheres"), has("key-points"), has("links"), has("levels"), has("error"), bodies};
}

}  // namespace

bool parse_options(int argc, char** argv, Options& o, int& exit_code) {
  CLI::App app("Draws the crowd of samples/crowd, and compares the pictures with ray tracing.");
  std::string size = "1280x720", tier = "best", screen_space = "on";
  std::vector<std::string> debug;
  std::uint32_t bodies = 1;
  o.cache = CROWD_CACHE;
  // If an option is given several times, the last value is used. Callers of a script can thus override the
  // script's values.
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.add_option("hero", o.hero_glb,
                 "the rigged character, a .glb or .gltf file. Default: a built-in character")
      ->check(CLI::ExistingFile);
  app.add_option("model", o.hero_nook,
                 "the model that was baked from the character, a .nook file. Default: the program bakes one "
                 "with the draft preset, and keeps it for the next run")
      ->check(CLI::ExistingFile);
  app.add_option("--context", o.context,
                 std::string("how to create the OpenGL context (default egl): ") + platform::context_kinds())
      ->check(CLI::IsMember({"egl", "osmesa"}));
  app.add_option("--characters", o.crowd.characters, "number of characters in the crowd. Default: 100")
      ->check(CLI::Range(1, 10000));
  app.add_option("--neighbours", o.crowd.neighbours,
                 "number of neighbours that darken each character, the nearest ones. Default: 4")
      ->check(CLI::Range(0, 16));
  app.add_option("--frames", o.frames, "number of pictures to draw. Default: 4")
      ->check(CLI::Range(1, 100000));
  app.add_option("--size", size, "size of a picture in pixels, WIDTHxHEIGHT. Default: 1280x720");
  app.add_option("--out", o.out, "write the pictures into this folder. Default: out/crowd");
  app.add_option("--report", o.report,
                 "write times and errors to this JSON file. Default: report.json in the folder of --out");
  app.add_option("--tier", tier,
                 "highest OpenGL tier to use: 33 (OpenGL 3.3), 43 (4.3, compute shaders) or best. Default: "
                 "best, the highest tier of the context")
      ->check(CLI::IsMember({"33", "43", "best"}));
  app.add_option("--screen-space", screen_space,
                 "on (default): also draw AO on the floor, from the screen-space pass and from the "
                 "characters. off: only AO on the characters")
      ->check(CLI::IsMember({"on", "off"}));
  app.add_option(
         "--light", o.lights,
         "light: a probe (.nook) or an environment map (.hdr, .exr). The first one lights the pictures, and "
         "each one is compared with path tracing. You can repeat the option. Default: a built-in sky")
      ->check(CLI::ExistingFile)
      ->allow_extra_args(false)  // so that the words after it are files
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("!--no-light", o.probe_light,
               "do not use a light with directions; light the pictures with constant ambient light times AO, "
               "and a key light");
  app.add_option("--record", o.record,
                 "record the frames of the screen-space pass into this folder, as frame_0000.nook and so on");
  app.add_flag("--measure-world", o.measure_world,
               "compare the world pass in the last frame with a slow reference that evaluates every caster "
               "at every pixel");
  app.add_option("--debug", debug,
                 "draw these debug views over the pictures; separate them by commas: spheres, key-points, "
                 "links (between bodies), levels (of detail), error (of AO)")
      ->delimiter(',')
      ->check(CLI::IsMember({"spheres", "key-points", "links", "levels", "error"}))
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--debug-bodies", bodies,
                 "with --debug: number of bodies, the nearest to the camera, whose spheres, key points and "
                 "errors are shown. Default: 1")
      ->check(CLI::Range(1, 10000));
  app.add_option("--lod-error", o.lod_error,
                 "largest error that a level of detail may have at 10 m from the camera, as root mean square "
                 "of AO. 0 (default) means always full detail")
      ->check(CLI::Range(0.0f, 1.0f));
  app.add_option("--seed", o.seed, "seed of the random positions, clips and rays. Default: 1");
  app.add_option("--cache", o.cache, "keep baked characters in this folder");
  app.add_flag("!--no-sheets", o.sheets, "do not write comparison sheets, and trace rays only for --light");
  app.add_flag("--quiet", o.quiet, "do not show progress");
  try {
    app.parse(argc, argv);
    for (const std::string& fault : {parse_size(size, o), parse_tier(tier, o)})
      if (!fault.empty()) throw CLI::ValidationError("--size", fault);
    o.screen_space = screen_space == "on";
    o.debug = debug_view(debug, bodies);
    if (!o.record.empty() && !o.screen_space)
      throw CLI::ValidationError("--record", "needs --screen-space on");
    if (o.report.empty()) o.report = o.out / "report.json";
    return true;
  } catch (const CLI::ParseError& e) {
    exit_code = app.exit(e) == 0 ? code_after_output(0) : 2;
    return false;
  }
}

}  // namespace crowd::lab
