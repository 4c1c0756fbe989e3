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

void add_import_options(Command command, bake::ImportOptions& options) {
  command.add_flag_callback(
      "--allow-outside-files", [&options] { options.linked = bake::LinkedFiles::anywhere; },
      "of a .gltf file: also read buffers and images that it names outside of its own folder (../)");
  command
      .add_option(
          "--mesh", options.meshes.only,
          "read only meshes of this name, of the node or the mesh; * and ? stand for any text and any "
          "character. Repeat it for more. Default: all that the file shows, without lower levels of "
          "detail (LOD1 and so on); `nook inspect` lists them")
      .one_each()
      .type_name("NAME");
  command
      .add_option("--without", options.meshes.without,
                  "leave out meshes of this name, as --mesh; give the options of the bake to other commands "
                  "as well")
      .one_each()
      .type_name("NAME");
}

}  // namespace nook::tool
