// nook inspect: what is inside a .nook file.
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
  std::filesystem::path input;
};

void run(const Options& options) {
  require_distinct_files({{{"the input", options.input}}, {{"--report", options.common.report}}, {}});
  require_place_of_table(options.common);
  const std::vector<std::byte> bytes = read_file(options.input);
  std::optional<platform::OutputFile> report;
  if (!options.common.report.empty())
    report.emplace(options.common.report, file_events(options.common.quiet));
  const Row rows = Row::array({naming_file(options.input, [&] { return describe(bytes); })});
  if (report) report->commit(Row{{"rows", rows}}.dump(2, ' ', false, Row::error_handler_t::replace) + "\n");
  print_table(options.common, table_text(rows), !options.common.report.empty());
}

}  // namespace

void add_inspect(Command tool) {
  const Command command = tool.add_subcommand("inspect", "show what a .nook file holds");
  const auto options = std::make_shared<Options>();
  command.add_input("file", options->input, "a .nook file").required();
  add_common_options(command, options->common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
