#include "bakers/tool/baking.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/raytrace/worker_arena.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/table.h"
#include "platform/output_file.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {
namespace {

BakeOutput baked(const BakeCommand& command, const std::function<BakeOutput()>& bake) {
  const auto stopped = [&] { return ToolError(exit_other, command.stopped); };
  BakeOutput output;
  try {
    bake::run_with_threads(command.common.threads, [&] { output = bake(); });
  } catch (const Failure& failure) {
    if (failure.code() == NOOK_ERROR_CANCELLED) throw stopped();
    throw;
  } catch (const ToolError&) {
    // A failure that got the name of an input arrives as this.
    if (interrupted()) throw stopped();
    throw;
  }
  // Ctrl-C after the last report of progress still counts.
  if (interrupted()) throw stopped();
  return output;
}

}  // namespace

BakeOutput one_row(bake::BakedFile file, std::initializer_list<const char*> only_in_report) {
  using Json = nlohmann::ordered_json;
  Json row = Json::parse(file.report);
  BakeOutput output;
  output.file = std::move(file.model);
  output.report =
      Json{{"rows", Json::array({row})}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  for (const char* key : only_in_report) row.erase(key);
  output.table = table_text(Json::array({std::move(row)}));
  return output;
}

void run_bake(BakeCommand command, const std::function<BakeOutput()>& bake) {
  const std::filesystem::path& report = command.common.report;
  CommandFiles& files = command.files;
  files.outputs.insert(files.outputs.begin(), {"-o", command.output});
  files.outputs.push_back({"--report", report});
  require_distinct_files(files);
  const platform::FileEvents events = file_events(command.common.quiet);
  platform::OutputFile output_file(command.output, events);
  std::optional<platform::OutputFile> report_file;
  if (!report.empty()) report_file.emplace(report, events);
  make_image_folder(files.images);
  const BakeOutput output = baked(command, bake);
  output_file.commit(output.file);
  if (report_file) report_file->commit(output.report);
  print_table(command.common, output.table, true);
}

}  // namespace nook::tool
