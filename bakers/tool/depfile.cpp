#include "bakers/tool/depfile.h"

#include "bakers/tool/command_end.h"

namespace nook::tool {
namespace {

// Ninja's depfile_parser.in.cc: a backslash before a space or # stands for the character alone, and a dollar
// is doubled. Backslashes directly before such an escape would count as escapes of their own, so they are
// doubled; all others stay.
std::string escaped(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (name.find_first_of("\n\r") != std::string::npos)
    throw ToolError(exit_bad_arguments, "--depfile: a name with a line break does not fit into a rule (got " +
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

}  // namespace

std::string depfile_text(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& read) {
  std::string text = escaped(output) + ":";
  for (const std::filesystem::path& path : read) text += " \\\n  " + escaped(path);
  return text + "\n";
}

}  // namespace nook::tool
