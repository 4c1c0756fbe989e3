#include "bakers/tool/common_options.h"

#include "bakers/tool/command_line.h"

namespace nook::tool {

void add_common_options(Command command, CommonOptions& options) {
  command.add_option("--threads", options.threads, "threads to work with; 0: all cores")
      .check(in_range(0, 1024))
      .capture_default_str();
  command
      .add_option("--seed", options.seed,
                  "of everything random; the same seed gives the same output on any number of threads")
      .capture_default_str();
  command.add_option("--report", options.report, "write a report as JSON to this file");
  command.add_flag("--quiet", options.quiet, "say nothing but errors");
}

void add_linked_files_option(Command command, bake::LinkedFiles& linked) {
  command.add_flag_callback(
      "--allow-outside-files", [&linked] { linked = bake::LinkedFiles::anywhere; },
      "of a .gltf file: also read buffers and images that it names outside of its own folder (../)");
}

}  // namespace nook::tool
