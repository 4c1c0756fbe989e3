#include "bakers/tool/baking.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/job/worker_arena.h"
#include "bakers/tool/image_folder.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/table.h"
#include "bakers/tool/tool_error.h"
#include "platform/output_file.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {
namespace {

ToolError stopped() {
  return ToolError(exit_other, "stopped; nothing was written");
}

bake::BakedFile baked(const CommonOptions& options, const std::function<bake::BakedFile()>& bake) {
  bake::BakedFile file;
  try {
    bake::run_with_threads(options.threads, [&] { file = bake(); });
  } catch (const Failure& failure) {
    if (failure.code() == NOOK_ERROR_CANCELLED) throw stopped();
    throw;
  } catch (const ToolError&) {
    // A failure that was given the name of an input comes as this.
    if (interrupted()) throw stopped();
    throw;
  }
  return file;
}

}  // namespace

void run_bake(const CommonOptions& options, const std::filesystem::path& output, CommandFiles files,
              const std::function<bake::BakedFile()>& bake) {
  using Json = nlohmann::ordered_json;
  files.outputs.push_back({"-o", output});
  files.outputs.push_back({"--report", options.report});
  require_distinct_files(files);
  platform::OutputFile output_file(output);
  std::optional<platform::OutputFile> report_file;
  if (!options.report.empty()) report_file.emplace(options.report);
  make_image_folder(files.images);
  const bake::BakedFile file = baked(options, bake);
  output_file.commit(file.model);
  const Json rows = Json::array({Json::parse(file.report)});
  if (report_file)
    report_file->commit(Json{{"rows", rows}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!options.quiet) std::fputs(table_text(rows).c_str(), stdout);
}

}  // namespace nook::tool
