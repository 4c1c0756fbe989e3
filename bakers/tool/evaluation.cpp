#include "bakers/tool/evaluation.h"

#include <optional>

#include "bakers/raytrace/worker_arena.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/stored_meshes.h"
#include "bakers/tool/table.h"
#include "platform/output_file.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {

void run_evaluation(const CommonOptions& options, CommandFiles files,
                    const std::function<nlohmann::ordered_json()>& evaluate) {
  using Json = nlohmann::ordered_json;
  files.outputs.push_back({"--report", options.report});
  require_distinct_files(files);
  require_place_of_table(options);
  make_image_folder(files.images);
  std::optional<platform::OutputFile> report_file;
  if (!options.report.empty()) report_file.emplace(options.report, file_events(options.quiet));
  Json report;
  try {
    bake::run_with_threads(options.threads, [&] { report = evaluate(); });
  } catch (const Failure& failure) {
    if (failure.code() == NOOK_ERROR_CANCELLED) throw ToolError(exit_other, "stopped; nothing was written");
    throw;
  }
  if (report_file) report_file->commit(report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  print_table(options, table_text(report["rows"]), !options.report.empty());
}

void add_evaluated_files(Command command, EvaluatedFiles& files) {
  command
      .add_input("input", files.character,
                 "the character that the model was baked from, a .glb or .gltf file")
      .required();
  command.add_input("model", files.model, "the baked model, a .nook file").required();
  add_import_options(command, files.reading);
}

std::vector<NamedFile> named_files(const EvaluatedFiles& files) {
  return {{"the character", files.character}, {"the model", files.model}};
}

measure::BakedCharacter read_evaluated_files(const EvaluatedFiles& files, const CommonOptions& options) {
  // Reads the model first, because it may have been baked from only some of the meshes.
  auto bytes = read_file(files.model);
  bake::ImportedCharacter imported = read_character(
      files.character, with_stored_meshes(files.reading, files.model, bytes, options), options);
  return naming_file(files.model,
                     [&] { return measure::read_baked_character(std::move(imported), std::move(bytes)); });
}

}  // namespace nook::tool
