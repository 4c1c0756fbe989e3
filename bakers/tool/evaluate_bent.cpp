// `nook evaluate bent` measures the bent normals of a character, and how much they improve glossy
// reflections.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/character/bent_study.h"
#include "bakers/measure/character/character_pictures.h"
#include "bakers/measure/character/character_report.h"
#include "bakers/measure/character/evaluated_character.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

// Width of the maps that are used for measuring. The suns are removed from these maps, because hosts draw
// suns as lights with their own shadows. The remaining light is smooth enough for the number of rays that a
// reflection uses.
constexpr std::uint32_t map_columns = 64;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  measure::PoseChoice poses;
  measure::BentStudy study;
  std::vector<std::filesystem::path> maps;
  std::filesystem::path images;
  std::size_t image_count = 2;
  float image_roughness = 0.3f;
};

// Draws poses, picked at even intervals, under the first map.
void draw(const Options& options, const measure::BakedCharacter& baked, const std::vector<bake::Pose>& poses,
          const measure::GlossyMap& map) {
  measure::GlossyPictureSettings settings;
  settings.roughness = options.image_roughness;
  settings.seed = options.common.seed;
  const std::size_t count = std::min(options.image_count, poses.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bake::Pose& pose = poses[(2 * i + 1) * poses.size() / (2 * count)];
    bake::write_png(options.images / ("glossy_" + std::to_string(i) + ".png"),
                    measure::glossy_picture(baked.character.mesh, baked.model, pose, map, settings));
  }
}

Json evaluate(const Options& options) {
  const measure::BakedCharacter baked = read_evaluated_files(options.files, options.common);
  require_clips(options.poses.clips, baked.character);
  std::vector<measure::GlossyMap> maps;
  for (const std::filesystem::path& path : options.maps)
    maps.push_back({path.stem().string(), measure::coarse_map(read_map(path), map_columns)});
  const std::optional<bake::Recipe> recipe = measure::stored_recipe(baked);
  const measure::EvaluatedPoses measured =
      measure::choose_poses(baked.character, recipe ? &*recipe : nullptr, options.poses);
  measure::BentStudy study = options.study;
  study.seed = measure::evaluation_ray_seed(options.common.seed);
  platform::ProgressBar bar(options.common.quiet);
  Json report;
  report["rows"] = measure::bent_rows(baked.character.mesh, baked.model, measured.poses, maps, study,
                                      [&](std::size_t done, std::size_t total) {
                                        bar.show("ray tracing", "poses", done, total);
                                        return !interrupted();
                                      });
  if (!options.images.empty()) draw(options, baked, measured.poses, maps.front());
  report["protocol"] = measured.protocol;
  report["clips"] = measured.clips;
  report["rays"] = study.rays;
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_bent(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "bent",
      "measure the bent normals and the specular occlusion of a character against ray tracing.\nSpecular "
      "occlusion is the unblocked share of a glossy reflection. It is measured at five roughness values, "
      "under uniform light and under the maps of --maps. S. Lagarde's formula, from the same AO, is measured "
      "for comparison.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  o.poses.most = 24;
  add_evaluated_files(command, o.files);
  const Option maps = command
                          .add_input("--maps", o.maps,
                                     "also measure under these latitude-longitude maps (.hdr or .exr), at "
                                     "most 8; separate them by commas. Default: only uniform light")
                          .delimiter(',')
                          .expected(1, int(bake::max_glossy_maps));
  command
      .add_option("--clips", o.poses.clips,
                  "measure only these clips; separate their names by commas. Default: the clips that the "
                  "model was not fitted to, or all clips if it was fitted to all")
      .delimiter(',');
  command.add_option("--samples-per-clip", o.poses.samples_per_clip, "number of poses to take from each clip")
      .check(in_range(1, 100000))
      .capture_default_str();
  command
      .add_option("--max-poses", o.poses.most,
                  "measure at most this many of these poses, picked at even intervals")
      .check(in_range(1, 10000000))
      .capture_default_str();
  command.add_option("--points", o.study.points, "number of vertices to measure in each pose")
      .check(in_range(1, 10000000))
      .capture_default_str();
  command
      .add_option("--rays", o.study.rays,
                  "number of rays per vertex for AO. A reflection takes a quarter of this number")
      .check(in_range(8, 65536))
      .capture_default_str();
  command
      .add_option("--images", o.images,
                  "write PNG files into this folder that show the body, glossy, under the first map: without "
                  "occlusion, with S. Lagarde's formula, with bent normals, and path traced")
      .needs(maps);
  command.add_option("--image-count", o.image_count, "with --images: number of poses to draw")
      .check(in_range(1, 1000))
      .capture_default_str();
  command
      .add_option("--image-roughness", o.image_roughness, "with --images: perceptual roughness of the body")
      .check(in_range(0.01, 1.0))
      .capture_default_str();
  add_common_options(command, o.common);
  command.callback([options] {
    std::vector<NamedFile> read = named_files(options->files);
    for (const std::filesystem::path& map : options->maps) read.push_back({"a map", map});
    run_evaluation(options->common, {read, {}, options->images}, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
