// `nook evaluate world` measures how a character darkens its surroundings. It compares Nook and the methods
// that engines use with ray tracing.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/character/character_report.h"
#include "bakers/measure/character/evaluated_character.h"
#include "bakers/measure/composite/composite.h"
#include "bakers/measure/world/silhouette.h"
#include "bakers/measure/world/world_pictures.h"
#include "bakers/measure/world/world_report.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "platform/platform.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  measure::PoseChoice poses;
  measure::WorldStudy study;
  std::filesystem::path images;
  std::size_t image_count = 3;
  bool composite = false, silhouettes = false;
  std::vector<std::filesystem::path> scenes;  // rooms to measure in addition to the built-in room
  std::vector<float> scene_metres;            // metres per unit of each scene
  bake::MeshSelection scene_meshes;           // the meshes to use, for all scenes
  measure::CompositeStudy rooms;
  std::vector<std::filesystem::path> lights;
};

std::vector<measure::MeasuredRoom> rooms_of(const Options& options) {
  std::vector<measure::MeasuredRoom> rooms{{"room", measure::own_room()}};
  for (std::size_t i = 0; i < options.scenes.size(); ++i) {
    const float metres = i < options.scene_metres.size() ? options.scene_metres[i] : 1;
    const bake::ImportOptions reading{options.files.reading.linked, options.scene_meshes};
    std::vector<std::string> warnings;
    rooms.push_back({options.scenes[i].stem().string(), naming_file(options.scenes[i], [&] {
                       return measure::room_of(options.scenes[i], metres, reading, warnings);
                     })});
    print_warnings(options.scenes[i], warnings, options.common);
  }
  return rooms;
}

// Throws if scenes are given without a measurement that uses rooms. The other measurements would silently
// ignore the scenes.
void require_rooms(const Options& options) {
  const bool has_rooms = options.composite || (!options.lights.empty() && !options.images.empty());
  if (!options.scenes.empty() && !has_rooms)
    throw ToolError(exit_bad_arguments,
                    "--scene names a room, but rooms are measured only with --composite, or with --light and "
                    "--images; add these options");
  if (options.scene_metres.size() > options.scenes.size())
    throw ToolError(exit_bad_arguments, "--scene-metres has " + std::to_string(options.scene_metres.size()) +
                                            " values for " + std::to_string(options.scenes.size()) +
                                            " of --scene; give at most one value for each scene");
}

Json composite_report(const Options& options, const measure::BakedCharacter& baked,
                      std::span<const bake::Pose> poses) {
  platform::ContextRequest request;
  request.major = request.minor = 3;
  const std::unique_ptr<platform::Context> context = platform::create_context(request);
  measure::CompositeStudy study = options.rooms;
  study.truth.seed = options.common.seed;
  study.truth.rays = options.study.rays;
  study.images = options.images;
  if (!options.images.empty()) std::filesystem::create_directories(options.images);
  platform::ProgressBar bar(options.common.quiet);
  return measure::composite_rows(*context, rooms_of(options), baked.character.mesh, baked.model,
                                 baked.model_bytes, poses, study, [&](std::size_t done, std::size_t total) {
                                   bar.show("ray tracing", "views", done, total);
                                   return !interrupted();
                                 });
}

std::vector<measure::NamedMap> maps_of(const Options& options) {
  std::vector<measure::NamedMap> maps;
  for (const std::filesystem::path& path : options.lights)
    maps.push_back({path.stem().string(), read_map(path)});
  return maps;
}

void draw_lit_rooms(const Options& options, const measure::BakedCharacter& baked,
                    std::span<const bake::Pose> poses, std::span<const measure::NamedMap> maps) {
  std::filesystem::create_directories(options.images);
  measure::LitRoomSettings settings;
  settings.figures = options.rooms.figures;
  settings.rays = options.study.rays;
  settings.seed = options.common.seed;
  for (const measure::NamedMap& map : maps) {
    const measure::SplitLight light = measure::split(map);
    for (const measure::MeasuredRoom& room : rooms_of(options))
      measure::write_lit_room(options.images / (room.name + "_" + map.name + ".png"), room,
                              baked.character.mesh, baked.model, poses, light, settings);
  }
}

Json evaluate(const Options& options) {
  const measure::BakedCharacter baked = read_evaluated_files(options.files, options.common);
  require_clips(options.poses.clips, baked.character);
  const std::optional<bake::Recipe> recipe =
      naming_file(options.files.model, [&] { return measure::stored_recipe(baked); });
  const measure::EvaluatedPoses measured =
      measure::choose_poses(baked.character, recipe ? &*recipe : nullptr, options.poses);
  measure::WorldStudy study = options.study;
  study.seed = options.common.seed;
  platform::ProgressBar bar(options.common.quiet);
  const measure::WorldProgress progress = [&](std::size_t done, std::size_t total) {
    bar.show("ray tracing", "poses", done, total);
    return !interrupted();
  };
  const std::vector<measure::NamedMap> maps = maps_of(options);
  Json report;
  report["rows"] = naming_file(options.files.model, [&] {
    if (options.composite) return composite_report(options, baked, measured.poses);
    if (options.silhouettes)
      return measure::silhouette_rows(baked.character.mesh, baked.model, measured.poses, study, progress);
    if (!maps.empty())
      return measure::world_light_rows(baked.character.mesh, baked.model, measured.poses, maps, study,
                                       progress);
    return measure::world_rows(baked.character.mesh, baked.model, measured.poses, study, progress);
  });
  if (!options.images.empty() && !maps.empty()) draw_lit_rooms(options, baked, measured.poses, maps);
  if (!options.images.empty() && !options.composite && maps.empty())
    measure::write_world_pictures(options.images, baked.character.mesh, baked.model, measured.poses,
                                  options.image_count, study.rays, study.seed);
  report["protocol"] = measured.protocol;
  report["clips"] = measured.clips;
  report["casters"] = baked.model.world_casters.size();
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_world(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "world",
      "measure how a baked character darkens the world around it, against ray tracing.\nThe measured "
      "surfaces are a floor, a wall 0.3 m away, a ring of floor around a point of contact, a neighbour, and "
      "the floor under cones of light. The methods are Nook's world casters, and methods that engines use. "
      "over_none is the mean squared error of a method, divided by the error without any darkening. "
      "over_capsules is the mean squared error of a method, divided by the error of one capsule per bone. "
      "low and high are 95 % bounds from a bootstrap over the poses.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  o.poses.most = 48;
  add_evaluated_files(command, o.files);
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
      .check(in_range(1, 100000))
      .capture_default_str();
  command.add_option("--points", o.study.points, "number of points to measure on each surface in each pose")
      .check(in_range(1, 90000))
      .capture_default_str();
  command
      .add_option("--rays", o.study.rays,
                  "number of rays per point. A cone of light takes an eighth of this number")
      .check(in_range(8, 65536))
      .capture_default_str();
  command.add_option("--images", o.images,
                     "write PNG files into this folder. They show floor and wall, darkened by ray tracing, "
                     "Nook, capsules and blobs. With --composite, they show each room by ray tracing, by "
                     "Nook, and by the screen pass alone. With --light, they show each lit room by ray "
                     "tracing, by Nook, by AO times the probe, and by capsules");
  command.add_option("--image-count", o.image_count, "with --images: number of poses to draw")
      .check(in_range(1, 1000))
      .capture_default_str();
  const Option composite = command.add_flag(
      "--composite", o.composite,
      "instead, measure world casters and the screen-space pass together, in pictures of rooms with "
      "characters. The report has separate rows for the pixels that the characters darken");
  const Option silhouettes =
      command
          .add_flag("--silhouettes", o.silhouettes,
                    "instead, compare the outlines of shadows on the floor. The light has a cone of 1 degree "
                    "and comes from 8 directions, 45 degrees above the floor; the floor is divided into "
                    "cells of 1 cm. iou is the area in which the shadow overlaps the ray-traced shadow, "
                    "divided by the area that at least one of them covers")
          .excludes(composite);
  command
      .add_input(
          "--light", o.lights,
          "instead, measure the irradiance of floor and wall under the light of this latitude-longitude map, "
          "against path tracing in each colour channel. You can give several maps")
      .check(existing_file())
      .excludes(composite)
      .excludes(silhouettes);
  const Option scene = command
                           .add_input("--scene", o.scenes,
                                      "with --composite, or with --light and --images: also use this room, "
                                      "besides the built-in one. Give a .glb or .gltf file with +y up")
                           .check(existing_file());
  command
      .add_option("--scene-metres", o.scene_metres,
                  "metres per unit of each --scene, in the same order. Default: 1")
      .check(in_range(1e-4f, 1e4f))
      .needs(scene);
  command
      .add_option("--scene-mesh", o.scene_meshes.only,
                  "read only the meshes with this name from each --scene, matched as in --mesh. (--mesh "
                  "itself chooses meshes of the character.)")
      .one_each()
      .needs(scene)
      .type_name("NAME");
  command
      .add_option("--scene-without", o.scene_meshes.without,
                  "leave out the meshes with this name from each --scene, such as a ceiling")
      .one_each()
      .needs(scene)
      .type_name("NAME");
  command.add_option("--views", o.rooms.views, "with --composite: number of views to draw of each room")
      .check(in_range(1, 1000))
      .capture_default_str()
      .needs(composite);
  command.add_option("--figures", o.rooms.figures, "number of characters to place in each room")
      .check(in_range(1, 100))
      .capture_default_str();
  add_common_options(command, o.common);
  command.callback([options] {
    require_rooms(*options);
    std::vector<NamedFile> inputs = named_files(options->files);
    for (const std::filesystem::path& light : options->lights) inputs.push_back({"--light", light});
    run_evaluation(options->common, {inputs, {}, options->images}, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
