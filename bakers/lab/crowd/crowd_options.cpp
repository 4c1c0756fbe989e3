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
  app.add_option("hero", o.hero_glb, "rigged character, a .glb or .gltf file; default: a built-in character")
      ->check(CLI::ExistingFile);
  app.add_option("model", o.hero_nook,
                 "model that was baked from the character, a .nook file; default: bake one (draft preset) "
                 "and cache it")
      ->check(CLI::ExistingFile);
  app.add_option("--context", o.context, std::string("OpenGL context: ") + platform::context_kinds())
      ->check(CLI::IsMember({"egl", "osmesa"}));
  app.add_option("--characters", o.crowd.characters, "number of characters")->check(CLI::Range(1, 10000));
  app.add_option("--neighbours", o.crowd.neighbours,
                 "number of nearest neighbours that darken each character")
      ->check(CLI::Range(0, 16));
  app.add_option("--frames", o.frames, "number of pictures to draw")->check(CLI::Range(1, 100000));
  app.add_option("--size", size, "size of a picture in pixels, WIDTHxHEIGHT");
  app.add_option("--out", o.out, "folder to write the pictures into");
  app.add_option("--report", o.report,
                 "JSON file to write times and errors to; default: report.json in --out");
  app.add_option("--tier", tier, "highest OpenGL tier: 33, 43 or best")
      ->check(CLI::IsMember({"33", "43", "best"}));
  app.add_option("--screen-space", screen_space,
                 "on or off: also draw AO on the floor, from the screen pass and from the characters")
      ->check(CLI::IsMember({"on", "off"}));
  app.add_option("--light", o.lights,
                 "probe (.nook) or environment map (.hdr, .exr). The first one lights the frames, and each "
                 "one is compared with path tracing. You can repeat the option. Default: a built-in sky")
      ->check(CLI::ExistingFile)
      ->allow_extra_args(false)  // so that the words after it are files
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("!--no-light", o.probe_light,
               "light the frames with constant ambient light times AO, and a key light");
  app.add_option("--record", o.record,
                 "folder to record frames of the screen-space pass into, as frame_0000.nook and so on");
  app.add_flag("--measure-world", o.measure_world,
               "compare the world pass in the last frame with a slow reference that evaluates every caster "
               "at every pixel");
  app.add_option("--debug", debug,
                 "debug views to draw over the picture, separated by commas: spheres, key-points, links, "
                 "levels, error")
      ->delimiter(',')
      ->check(CLI::IsMember({"spheres", "key-points", "links", "levels", "error"}))
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--debug-bodies", bodies,
                 "number of bodies for which debug views show spheres, key points and errors; the bodies "
                 "nearest to the camera are chosen")
      ->check(CLI::Range(1, 10000));
  app.add_option(
         "--lod-error", o.lod_error,
         "largest error of a level of detail at 10 m, as root mean square of AO; 0 means always full detail")
      ->check(CLI::Range(0.0f, 1.0f));
  app.add_option("--seed", o.seed, "seed of positions, clips and rays");
  app.add_option("--cache", o.cache, "folder that caches baked characters");
  app.add_flag("!--no-sheets", o.sheets, "write no comparison sheets, and trace no rays except for --light");
  app.add_flag("--quiet", o.quiet, "show no progress");
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
