// `nook export casters` writes the world casters of a model as text for other engines.
#include "bakers/measure/world/caster_export.h"
#include "bakers/tool/command_line.h"

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/tool/command_files.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/table.h"
#include "platform/output_file.h"
#include "sdk/src/character/model_file.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::filesystem::path model, output;
  measure::CasterFormat format = measure::CasterFormat::gltf;
  measure::CasterRadii radii = measure::CasterRadii::ao;
};

const std::map<std::string, measure::CasterFormat> formats{{"unreal", measure::CasterFormat::unreal},
                                                           {"source2", measure::CasterFormat::source2},
                                                           {"gltf", measure::CasterFormat::gltf}};
const std::map<std::string, measure::CasterRadii> radii_names{{"ao", measure::CasterRadii::ao},
                                                              {"light", measure::CasterRadii::light}};

template <class Names, class Value>
std::string name_of(const Names& names, Value value) {
  for (const auto& [name, named] : names)
    if (named == value) return name;
  return "";
}

void run(const Options& o) {
  require_distinct_files({{{"the model", o.model}}, {{"-o", o.output}, {"--report", o.common.report}}, {}});
  const std::vector<std::byte> bytes = read_file(o.model);
  const platform::FileEvents events = file_events(o.common.quiet);
  platform::OutputFile output(o.output, events);
  std::optional<platform::OutputFile> report;
  if (!o.common.report.empty()) report.emplace(o.common.report, events);
  const CharacterModel model = naming_file(o.model, [&] { return read_character_model(bytes); });
  output.commit(naming_file(o.model, [&] { return measure::export_casters(model, o.format, o.radii); }));
  const measure::ExportError error = measure::export_error(model, o.format, o.radii);
  const Json rows = Json::array({{{"format", name_of(formats, o.format)},
                                  {"radii", name_of(radii_names, o.radii)},
                                  {"casters", model.world_casters.size()},
                                  {"rms", error.rms},
                                  {"largest", error.largest},
                                  {"over_none", error.over_none}}});
  if (report) report->commit(Json{{"rows", rows}}.dump(2) + "\n");
  print_table(o.common, table_text(rows), true);
}

}  // namespace

void add_export_casters(Command export_command) {
  const Command command = export_command.add_subcommand(
      "casters",
      "write the world casters of a baked character for another engine.\nWorld casters are the capsules with "
      "which a body darkens the world around it. The table compares the AO of the written casters with the "
      "AO of Nook's own casters, on the floor below the rest pose: rms is the root mean square difference, "
      "and largest is the largest difference. over_none is the mean squared difference, divided by the "
      "difference without any casters.");
  const auto options = std::make_shared<Options>();
  command.add_input("model", options->model, "the baked model, a .nook file that `nook bake character` wrote")
      .required();
  command.add_option("-o,--output", options->output, "write the casters to this file").required();
  command.add_choice(
      "--format", options->format, formats,
      "format of the file: gltf (default, extras of a glTF file, in metres), source2 (capsules of a ModelDoc "
      "file, in inches) or unreal (bodies of a physics asset as text, in centimetres)");
  command.add_choice("--radii", options->radii, radii_names,
                     "for unreal and source2, whose capsules have only one radius: write the radius that is "
                     "fitted to ambient occlusion (ao, default) or to shadows of lights (light)");
  add_common_options(command, options->common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
