#include "bakers/tool/common_options.h"

#include "bakers/tool/command_line.h"

namespace nook::tool {

void add_common_options(Command command, CommonOptions& options) {
  command.add_option("--threads", options.threads, "use this many threads; 0 means one thread per core")
      .check(in_range(0, 1024))
      .capture_default_str();
  command
      .add_option("--seed", options.seed,
                  "start all random numbers from this seed. The same seed gives the same output, even with "
                  "another number of threads")
      .capture_default_str();
  command.add_option("--report", options.report, "write a JSON report to this file");
  command.add_flag("--quiet", options.quiet, "print errors only");
}

void add_import_options(Command command, bake::ImportOptions& options) {
  command.add_flag_callback(
      "--allow-outside-files", [&options] { options.linked = bake::LinkedFiles::anywhere; },
      "for a .gltf file: also read buffers and images that lie outside the file's folder (../). Without this "
      "option, such a file is rejected");
  command
      .add_option("--mesh", options.meshes.only,
                  "read only the meshes with this name. The name of the mesh or of its node must match NAME, "
                  "where * matches any text and ? any character. You can repeat the option. Default: all "
                  "meshes that are not hidden, but not the simplified copies (LOD1, LOD2 and so on). `nook "
                  "inspect FILE` lists the meshes of a file")
      .one_each()
      .type_name("NAME");
  command
      .add_option("--without", options.meshes.without,
                  "leave out the meshes with this name, matched as in --mesh. You can repeat the option. If "
                  "you give neither --mesh nor --without, a command that reads a baked file together with "
                  "its source uses the meshes of that bake")
      .one_each()
      .type_name("NAME");
}

}  // namespace nook::tool
