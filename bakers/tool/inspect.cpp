// nook inspect: shows what is inside a .nook file, and what a bake would take from a glTF file.
#include <cstring>
#include <memory>
#include <optional>

#include "bakers/import/gltf_contents.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
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
  bake::ImportOptions reading;
};

struct Table {
  const char* title;  // its key in the report
  Row rows;
};

bool is_gltf(const std::vector<std::byte>& bytes) {
  const auto text = [&](std::size_t i) { return static_cast<char>(bytes[i]); };
  if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) return true;
  std::size_t i = 0;
  while (i < bytes.size() && std::strchr(" \t\r\n\xef\xbb\xbf", text(i)) && text(i) != 0) ++i;
  return i < bytes.size() && text(i) == '{';
}

// Returns the meshes, skins and clips of a file, and which primitive of a bake is which node.
std::vector<Table> tables_of_gltf(const Options& options) {
  const bake::GltfContents contents =
      naming_file(options.input, [&] { return bake::list_gltf(options.input, options.reading); });
  print_warnings(options.input, contents.warnings, options.common);
  Row meshes = Row::array(), skins = Row::array(), clips = Row::array();
  for (const bake::ContentsMesh& mesh : contents.meshes) {
    Row row;
    row["primitive"] = mesh.primitive < 0 ? Row() : Row(mesh.primitive);
    row["node"] = mesh.node;
    row["mesh"] = mesh.mesh;
    row["triangles"] = mesh.triangles;
    row["vertices"] = mesh.vertices;
    row["instances"] = mesh.instances;
    const bool has_skin = mesh.skin >= 0 && std::size_t(mesh.skin) < contents.skins.size();
    row["skin"] = has_skin ? Row(contents.skins[std::size_t(mesh.skin)].name) : Row();
    row["state"] = mesh.state;
    meshes.push_back(row);
  }
  for (const bake::ContentsSkin& skin : contents.skins)
    skins.push_back({{"skin", skin.name}, {"joints", skin.joints}, {"meshes", skin.meshes}});
  for (const bake::ContentsClip& clip : contents.clips)
    clips.push_back({{"clip", clip.name}, {"seconds", clip.duration_s}});
  return {{"rows", meshes}, {"skins", skins}, {"clips", clips}};
}

void run(const Options& options) {
  require_distinct_files({{{"the input", options.input}}, {{"--report", options.common.report}}, {}});
  require_place_of_table(options.common);
  const std::vector<std::byte> bytes = read_file(options.input);
  std::optional<platform::OutputFile> report;
  if (!options.common.report.empty())
    report.emplace(options.common.report, file_events(options.common.quiet));
  std::vector<Table> tables;
  if (is_gltf(bytes))
    tables = tables_of_gltf(options);
  else
    tables = {{"rows", Row::array({naming_file(options.input, [&] { return describe(bytes); })})}};
  Row all;
  std::string text;
  for (const Table& table : tables) {
    all[table.title] = table.rows;
    if (table.rows.empty()) continue;
    if (!text.empty()) text += '\n';
    text += table_text(table.rows);
  }
  if (report) report->commit(all.dump(2, ' ', false, Row::error_handler_t::replace) + "\n");
  print_table(options.common, text, !options.common.report.empty());
}

}  // namespace

void add_inspect(Command tool) {
  const Command command = tool.add_subcommand("inspect",
                                              "show what a .nook file holds, or list the meshes, skins and "
                                              "clips of a glTF file and what of them a bake "
                                              "takes");
  const auto options = std::make_shared<Options>();
  command.add_input("file", options->input, "a .nook, .glb or .gltf file").required();
  add_import_options(command, options->reading);
  add_common_options(command, options->common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
