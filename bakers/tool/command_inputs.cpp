#include "bakers/tool/command_inputs.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "platform/printable.h"

namespace nook::tool {

void print_warnings(const std::filesystem::path& path, const std::vector<std::string>& warnings,
                    const CommonOptions& common) {
  if (common.quiet) return;
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "%s: %s\n", platform::printable(path.string()).c_str(),
                 platform::printable_lines(warning).c_str());
}

bake::ImportedCharacter read_character(const std::filesystem::path& path, const bake::ImportOptions& reading,
                                       const CommonOptions& common) {
  bake::ImportedCharacter character = naming_file(path, [&] { return bake::import_gltf(path, reading); });
  print_warnings(path, character.warnings, common);
  return character;
}

bake::RigCorrections read_rig_file(const std::filesystem::path& path, const bake::SkinnedMesh& mesh) {
  if (path.empty()) return {};
  const std::vector<std::byte> bytes = read_file(path);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    return bake::read_rig(mesh, text);
  } catch (const Failure& failure) {
    throw ToolError(exit_bad_input, path.string() + ": " + failure.what());
  }
}

void require_clips(const std::vector<std::string>& wanted, const bake::ImportedCharacter& character) {
  std::vector<std::string> present;
  for (const bake::Clip& clip : character.clips) present.push_back(clip.name);
  std::sort(present.begin(), present.end());
  for (const std::string& name : wanted) {
    if (std::binary_search(present.begin(), present.end(), name)) continue;
    std::string text = "--clips: there is no clip \"" + name + "\"; the file has ";
    text += present.empty() ? "no clips at all" : "these:";
    for (const std::string& there : present) text += "\n  " + platform::printable(there);
    throw ToolError(exit_bad_arguments, text);
  }
}

bake::Environment read_map(const std::filesystem::path& path) {
  return naming_file(path, [&] { return bake::probe::read_environment(path); });
}

bake::ProbeScene read_probe_scene(const std::filesystem::path& path, const std::filesystem::path& light,
                                  bool textures, const bake::ImportOptions& reading,
                                  const CommonOptions& common) {
  std::vector<std::string> warnings;
  bake::LitTriangles triangles =
      naming_file(path, [&] { return bake::read_lit_triangles(path, textures, reading, warnings); });
  print_warnings(path, warnings, common);
  return bake::make_probe_scene(std::move(triangles), read_map(light));
}

}  // namespace nook::tool
