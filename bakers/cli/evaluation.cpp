#include "cli/evaluation.h"

#include <cstdio>
#include <optional>

#include "api/worker_arena.h"
#include "cli/output_file.h"
#include "cli/picture_file.h"
#include "cli/table.h"
#include "cli/tool_error.h"
#include "core/failure.h"

namespace nook::cli {

void run_evaluation(const CommonOptions& options, CommandFiles files,
                    const std::function<nlohmann::ordered_json()>& evaluate) {
  using Json = nlohmann::ordered_json;
  files.outputs.push_back({"--report", options.report});
  require_distinct_files(files);
  make_image_folder(files.images);
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
