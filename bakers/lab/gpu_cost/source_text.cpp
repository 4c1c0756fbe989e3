#include "bakers/lab/gpu_cost/source_text.h"

#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace nook::lab {
namespace {

constexpr std::string_view include_begin = "#include \"";

void expand(const std::filesystem::path& root, const std::string& text, std::set<std::string>& included,
            std::string& out) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#version")) continue;
    if (!line.starts_with(include_begin) || line.back() != '"') {
      out += line + '\n';
      continue;
    }
    const std::string path = line.substr(include_begin.size(), line.size() - include_begin.size() - 1);
    if (included.insert(path).second) expand(root, file_text(root / path), included, out);
  }
}

}  // namespace

std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("nook_gpu_cost: cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string expand_includes(const std::filesystem::path& root, const std::string& text) {
  std::string out;
  std::set<std::string> included;
  expand(root, text, included, out);
  return out;
}

std::string with_version(Stage stage, const std::string& defines, const std::string& text) {
  return (stage == Stage::compute ? "#version 430 core\n" : "#version 330 core\n") + defines + text;
}

}  // namespace nook::lab
