#include "cli/evaluation.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "api/worker_arena.h"
#include "character/model_file.h"
#include "cli/input_file.h"
#include "cli/output_file.h"
#include "cli/table.h"

namespace nook::cli {
namespace {

void require_same_character(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                            const std::filesystem::path& path) {
  const auto differ = [&](const char* what, std::size_t got, std::size_t needed) {
    if (got != needed)
      throw ToolError(exit_bad_input, path.string() + ": the model was not baked from this character (" +
                                          what + ": got " + std::to_string(got) + ", need " +
                                          std::to_string(needed) + "); bake it again");
  };
  differ("bones", model.bone_count(), mesh.bones.size());
  differ("vertices", model.vertex_count(), mesh.vertex_count());
  differ("file vertices", model.file_to_welded.size(), mesh.file_to_welded.size());
}

}  // namespace

void add_evaluated_files(CLI::App& command, EvaluationOptions& options) {
  command.add_option("input", options.character, "the character it was baked from, .glb or .gltf")
      ->required();
  command.add_option("model", options.model, "the .nook file")->required();
}

BakedCharacter read_baked_character(const EvaluationOptions& options) {
  BakedCharacter baked;
  baked.character = naming_file(options.character, [&] { return bake::import_gltf(options.character); });
  baked.model_bytes = read_file(options.model);
  baked.model = naming_file(options.model, [&] { return read_character_model(baked.model_bytes); });
  require_same_character(baked.character.mesh, baked.model, options.model);
  return baked;
}

void run_evaluation(const CommonOptions& options, const std::function<nlohmann::ordered_json()>& evaluate) {
  using Json = nlohmann::ordered_json;
  std::optional<OutputFile> report_file;
  if (!options.report.empty()) report_file.emplace(options.report);
  Json report;
  try {
    bake::run_with_threads(options.threads, [&] { report = evaluate(); });
  } catch (const Failure& failure) {
    if (failure.code() == NOOK_ERROR_CANCELLED) throw ToolError(exit_other, "stopped; nothing was written");
    throw;
  }
  if (report_file) report_file->commit(report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!options.quiet) std::fputs(table_text(report["rows"]).c_str(), stdout);
}

}  // namespace nook::cli
