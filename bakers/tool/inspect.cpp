// nook inspect: what is inside a .nook file.
#include <cstdio>
#include <memory>
#include <optional>

#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/inspect/describe.h"
#include "bakers/tool/table.h"
#include "platform/output_file.h"

namespace nook::tool {

namespace {

struct Options {
  CommonOptions common;
  std::string input;
};

void run(const Options& options) {
  require_distinct_files({{{"the input", options.input}}, {{"--report", options.common.report}}, {}});
  const std::vector<std::byte> bytes = read_file(options.input);
  std::optional<platform::OutputFile> report;
  if (!options.common.report.empty()) report.emplace(options.common.report);
  const Row rows = Row::array({naming_file(options.input, [&] { return describe(bytes); })});
  if (report) report->commit(Row{{"rows", rows}}.dump(2, ' ', false, Row::error_handler_t::replace) + "\n");
  if (!options.common.quiet) std::fputs(table_text(rows).c_str(), stdout);
}

}  // namespace

void add_inspect(Command tool) {
  const Command command = tool.add_subcommand("inspect", "show what a .nook file holds");
  const auto options = std::make_shared<Options>();
  command.add_option("file", options->input, "a .nook file").required();
  add_common_options(command, options->common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
