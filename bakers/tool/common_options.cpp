#include "bakers/tool/common_options.h"

#include "bakers/tool/command_line.h"

namespace nook::tool {

void add_common_options(Command command, CommonOptions& options) {
  command.add_option("--threads", options.threads, "number of threads; 0 means one per core")
      .check(in_range(0, 1024))
      .capture_default_str();
  command
      .add_option("--seed", options.seed,
                  "seed of all random numbers; the same seed gives the same output on any number of threads")
      .capture_default_str();
  command.add_option("--report", options.report, "write a JSON report to this file");
  command.add_flag("--quiet", options.quiet, "print errors only");
}

void add_import_options(Command command, bake::ImportOptions& options) {
  command.add_flag_callback(
      "--allow-outside-files", [&options] { options.linked = bake::LinkedFiles::anywhere; },
      "for a .gltf file: also read buffers and images outside the file's folder (../)");
  command
      .add_option("--mesh", options.meshes.only,
                  "read only the meshes whose node or mesh has this name; * matches any text and ? any "
                  "character. You can repeat the option. Default: all visible meshes without lower levels of "
                  "detail (LOD1 and so on); `nook inspect` lists them")
      .one_each()
      .type_name("NAME");
  command
      .add_option("--without", options.meshes.without,
                  "leave out the meshes of this name, matched as in --mesh. Commands that read a baked "
                  "character or transfer read the same meshes as its bake, unless you choose others")
      .one_each()
      .type_name("NAME");
}

}  // namespace nook::tool
