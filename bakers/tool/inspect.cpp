// `nook inspect` shows what is inside a .nook file, and what a bake would use from a glTF file.
#include <cstring>
#include <memory>
#include <optional>

#include "bakers/import/foreign_formats.h"
#include "bakers/import/gltf_contents.h"
#include "bakers/measure/character/rig_pictures.h"
#include "bakers/tool/command_end.h"
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
  bool shows_rig = false;
  std::filesystem::path rig, images;
};

struct Table {
  const char* title;  // the table's key in the report
  Row rows;
};

bool is_gltf(const std::vector<std::byte>& bytes) {
  const auto text = [&](std::size_t i) { return static_cast<char>(bytes[i]); };
  if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) return true;
  std::size_t i = 0;
  while (i < bytes.size() && std::strchr(" \t\r\n\xef\xbb\xbf", text(i)) && text(i) != 0) ++i;
  return i < bytes.size() && text(i) == '{';
}

bool is_nook(const std::vector<std::byte>& bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "NOOK", 4) == 0;
}

// Returns the meshes, skins and clips of a file, and which node each primitive of a bake comes from.
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

// Returns a table of the bones, and a table that says how much automatic poses tear the skin.
std::vector<Table> tables_of_rig(const Options& options) {
  const bake::ImportedCharacter character = read_character(options.input, options.reading, options.common);
  const bake::RigCorrections corrections = read_rig_file(options.rig, character.mesh);
  if (!options.images.empty())
    measure::write_rig_picture(options.images, character.mesh,
                               bake::joint_roles(character.mesh, corrections));
  return {{"rows", measure::torn_edge_rows(character, corrections, options.common.seed)},
          {"bones", measure::bone_rows(character.mesh, corrections)}};
}

void require_rig_options(const Options& options, bool gltf) {
  if (options.shows_rig && !gltf)
    throw ToolError(exit_bad_arguments, "inspect: --rig works only with a .glb or .gltf file (got " +
                                            options.input.string() + ")");
  if (!options.shows_rig && !options.images.empty())
    throw ToolError(exit_bad_arguments, "inspect: --images draws the rig, so it needs --rig; add --rig");
}

void run(const Options& options) {
  require_distinct_files(
      {{{"the input", options.input}, {"--rig", options.rig}}, {{"--report", options.common.report}}, {}});
  require_place_of_table(options.common);
  const std::vector<std::byte> bytes = read_file(options.input);
  std::optional<platform::OutputFile> report;
  if (!options.common.report.empty())
    report.emplace(options.common.report, file_events(options.common.quiet));
  std::vector<Table> tables;
  const char* format = is_nook(bytes) ? nullptr : bake::foreign_format(bytes);
  if (format)
    throw ToolError(exit_bad_input, options.input.string() + ": this is " + format +
                                        ", not a .nook or glTF file; give a .nook, .glb or .gltf file");
  require_rig_options(options, is_gltf(bytes));
  if (options.shows_rig)
    tables = tables_of_rig(options);
  else if (is_gltf(bytes))
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
  const Command command =
      tool.add_subcommand("inspect",
                          "show what a .nook or glTF file contains.\nFor a glTF file, the command lists its "
                          "meshes, skins and clips, and says which meshes a bake would use.");
  const auto options = std::make_shared<Options>();
  command.add_input("file", options->input, "a .nook, .glb or .gltf file").required();
  add_import_options(command, options->reading);
  command
      .add_option_function(
          "--rig",
          [options = options.get()](const std::string& path) {
            options->shows_rig = true;
            options->rig = path;
          },
          "for a glTF file: also show how a bake understands the rig: the role, side, limb, partner and "
          "parent of each bone, and the number of mesh edges that generated poses tear apart. If you give a "
          "rig FILE, its corrections are applied first")
      .expected(0, 1)
      .type_name("[FILE]");
  command.add_option("--images", options->images,
                     "with --rig: write rig.png into this folder. It shows the body, and colours show the "
                     "roles of the bones");
  add_common_options(command, options->common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
