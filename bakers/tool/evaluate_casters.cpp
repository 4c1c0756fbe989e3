// `nook evaluate casters` measures how much a single neighbour darkens a character, with each form and with
// ray tracing.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "bakers/measure/character/character_pictures.h"
#include "bakers/measure/character/character_report.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

// The clips of the receiver and the caster, the caster's position relative to the receiver in metres, and the
// caster's turn in degrees.
using Contact = std::tuple<std::string, std::string, float, float, float, float>;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  measure::CasterStudy study;
  std::size_t poses = 4;
  Contact contact;
  std::filesystem::path images;
};

std::string picture_name(float distance_m) {
  char name[32];
  std::snprintf(name, sizeof name, "pair_%g_m.png", double(distance_m));
  return name;
}

Json report_of(const std::vector<measure::CasterRow>& rows, std::uint64_t seed) {
  Json report;
  report["rows"] = measure::caster_rows(rows);
  report["seed"] = seed;
  return report;
}

Json evaluate(const Options& options) {
  const measure::BakedCharacter baked = read_evaluated_files(options.files, options.common);
  measure::CasterStudy study = options.study;
  study.seed = options.common.seed;
  platform::ProgressBar bar(options.common.quiet);
  const bake::SkinnedMesh& mesh = baked.character.mesh;
  if (!std::get<0>(options.contact).empty()) {
    const auto& [receiver, caster, x, y, z, degrees] = options.contact;
    const measure::BodyPair pair = measure::contact_pair(baked, receiver, caster, {x, y, z}, degrees);
    if (!options.images.empty())
      measure::write_pair_picture(options.images / "contact.png", mesh, baked.model, pair, study);
    return report_of(measure::measure_pair(mesh, baked.model, pair, study), study.seed);
  }
  const std::vector<bake::Pose> poses = measure::caster_poses(baked.character, options.poses);
  const auto rows =
      measure::measure_casters(mesh, baked.model, poses, study, [&](std::size_t done, std::size_t total) {
        bar.show("ray tracing neighbours", "pairs", done, total);
        return !interrupted();
      });
  if (!options.images.empty())
    for (const float distance : study.distances) {
      const float distance_m = measure::distance_in_metres(study, baked.model, distance);
      measure::write_pair_picture(options.images / picture_name(distance_m), mesh, baked.model,
                                  measure::body_pair(baked.model, poses, 0, 0, study.bearings, distance_m),
                                  study);
    }
  return report_of(rows, study.seed);
}

}  // namespace

void add_evaluate_casters(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "casters",
      "measure how much a neighbour darkens a body, against ray tracing.\nThe neighbour is the same "
      "character. It stands 0.3 to 10 m away (--distances), in several directions and poses. The table shows "
      "the mean darkening by ray tracing and by each form of casters, and the error of each form.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  add_evaluated_files(command, o.files);
  command.add_option("--rays", o.study.rays, "number of rays per vertex and pose")
      .check(in_range(1, 65536))
      .capture_default_str();
  const Option bearings = command
                              .add_option("--bearings", o.study.bearings,
                                          "number of directions from the body in which the neighbour stands")
                              .check(in_range(1, 360))
                              .capture_default_str();
  const Option poses =
      command.add_option("--poses", o.poses, "number of poses to measure, spread over the clips")
          .check(in_range(1, 1000))
          .capture_default_str();
  const Option distances =
      command
          .add_option("--distances", o.study.distances,
                      "distances along the ground between the middles of both bodies, in metres; separate "
                      "them by commas. Vertices inside the neighbour are not measured")
          .delimiter(',')
          .check(in_range(0.01, 1000.0))
          .default_str("0.3,0.5,0.75,1,2,3,5,10");
  const Option radii = command.add_flag(
      "--radii", o.study.in_radii,
      "the unit of --distances is the bounding radius of the body instead of metres, so that you can compare "
      "bodies of different size. The bounding radius of a person is about 1 m");
  const Option contact = command.add_option(
      "--contact", o.contact,
      "instead of --distances, measure two bodies that darken each other, each in the middle of a clip. Give "
      "the clip of each body, the position of the second body relative to the middle of the first one (X Y Z "
      "in metres), and the angle by which the second body is turned about the vertical axis");
  contact.type_name("CLIP CLIP X Y Z DEGREES");
  for (const Option unused : {bearings, poses, distances, radii}) contact.excludes(unused);
  command.add_option(
      "--images", o.images,
      "write PNG files into this folder that show both bodies, at each distance or as --contact places them");
  add_common_options(command, o.common);
  command.callback([options] {
    run_evaluation(options->common, {named_files(options->files), {}, options->images},
                   [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
