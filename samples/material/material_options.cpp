#include "samples/material/material_options.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include <nook/nook_material.h>

#include "platform/platform.h"
#include "platform/standard_streams.h"

namespace material {

bool parse_options(int argc, char** argv, Options& o, int& exit_code) {
  CLI::App app("Draws baked materials on several shapes, while the light and the view move.");
  std::string size = "960x540";
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.add_option("materials", o.files, "the materials to draw, .nook files that `nook bake material` wrote")
      ->required()
      ->check(CLI::ExistingFile)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--context", o.context,
                 std::string("how to create the OpenGL context (default egl): ") + platform::context_kinds())
      ->check(CLI::IsMember({"window", "egl", "osmesa"}));
  CLI::Option* const frames = app.add_option("--frames", o.frames,
                                             "number of pictures to draw of each material. Default: 6. With "
                                             "--context window, 0 (default) draws until you close the window")
                                  ->check(CLI::Range(0, 100000));
  app.add_option("--size", size, "size of a picture in pixels, WIDTHxHEIGHT. Default: 960x540");
  app.add_option("--tile", o.tile_m,
                 "side of one tile of the material on the shapes, in metres. Default: 0.16")
      ->check(CLI::Range(0.01f, 1.0f));
  app.add_option("--fetches", o.fetches,
                 "number of texture fetches of each mode along the longer side of a pixel. More fetches keep "
                 "the picture sharp at grazing angles. 0 means one fetch, at the mipmap level of the longer "
                 "side. Default: 2")
      ->check(CLI::Range(0, int(NOOK_MATERIAL_MAX_FETCHES)));
  app.add_flag("--one-sided", o.is_one_sided,
               "do not draw the insides of the shapes, which are visible through holes");
  app.add_option("--out", o.out, "write the pictures into this folder. Default: out/material");
  app.add_option(
      "--report", o.report,
      "write sizes, fetches and times to this JSON file. Default: report.json in the folder of --out");
  app.add_flag("--quiet", o.quiet, "do not show progress");
  try {
    app.parse(argc, argv);
    char rest = 0;
    if (std::sscanf(size.c_str(), "%dx%d%c", &o.width_px, &o.height_px, &rest) != 2 || o.width_px < 16 ||
        o.height_px < 16 || o.width_px > 8192 || o.height_px > 8192)
      throw CLI::ValidationError("--size", "got '" + size + "', need WIDTHxHEIGHT from 16x16 to 8192x8192");
    // A window stays open until it is closed, unless pictures are requested.
    if (o.context == "window" && frames->count() == 0) o.frames = 0;
    if (o.context != "window" && o.frames == 0)
      throw CLI::ValidationError("--frames", "got 0, need 1 or more");
    if (o.report.empty()) o.report = o.out / "report.json";
    return true;
  } catch (const CLI::ParseError& e) {
    exit_code = app.exit(e) == 0 ? code_after_output(0) : 2;
    return false;
  }
}

}  // namespace material
