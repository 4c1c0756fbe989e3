#include "bakers/tool/depfile.h"

#include <algorithm>
#include <string_view>

#include "bakers/tool/command_end.h"

namespace nook::tool {
namespace {

// Escapes a path in the way that Ninja's depfile_parser.in.cc reads. A space or # gets a backslash in front,
// and a dollar sign is doubled. Backslashes directly before such an escape would be read as escapes
// themselves, so they are doubled. All other backslashes are unchanged.
std::string escaped(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (name.find_first_of("\n\r") != std::string::npos)
    throw ToolError(exit_bad_arguments, "--depfile: a rule cannot contain a name with a line break (got " +
                                            name + "); rename the file");
  std::string text;
  std::size_t backslashes = 0;
  for (const char c : name) {
    if (c == ' ' || c == '#') text += std::string(backslashes, '\\') + '\\';
    if (c == '$') text += '$';
    text += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return text;
}

// Returns true if depfile_parser.in.cc of Ninja 1.11 accepts the character in a name, plain or escaped.
bool is_read_by_ninja(char c) {
  constexpr std::string_view others = "+,/_:.~()}{%=@[]!- #$\\";
  const bool is_plain =
      (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
  return is_plain || others.find(c) != std::string_view::npos;
}

}  // namespace

std::string name_that_ninja_cuts(const std::filesystem::path& output,
                                 const std::vector<std::filesystem::path>& read) {
  std::vector<std::filesystem::path> names{output};
  names.insert(names.end(), read.begin(), read.end());
  const auto is_cut = [](const std::filesystem::path& path) {
    const std::string name = path.string();
    return !std::all_of(name.begin(), name.end(), is_read_by_ninja);
  };
  const auto found = std::find_if(names.begin(), names.end(), is_cut);
  return found == names.end() ? "" : found->string();
}

std::string depfile_text(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& read) {
  std::string text = escaped(output) + ":";
  for (const std::filesystem::path& path : read) text += " \\\n  " + escaped(path);
  return text + "\n";
}

}  // namespace nook::tool
