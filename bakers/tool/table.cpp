#include "bakers/tool/table.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "bakers/tool/command_end.h"
#include "platform/output_stream.h"
#include "platform/printable.h"

namespace nook::tool {
namespace {

std::string cell_text(const nlohmann::ordered_json& value) {
  if (value.is_string()) return platform::printable(value.get<std::string>());
  if (!value.is_number_float())
    return value.is_null() ? "-"
                           : platform::printable(value.dump(
                                 -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value.get<double>());
  return text;
}

}  // namespace

std::string table_text(const nlohmann::ordered_json& rows) {
  if (rows.empty()) return "";
  std::vector<std::string> keys;
  for (const auto& item : rows.front().items()) keys.push_back(item.key());
  std::vector<std::vector<std::string>> cells;
  for (const auto& row : rows) {
    cells.emplace_back();
    for (const std::string& key : keys)
      cells.back().push_back(row.contains(key) ? cell_text(row.at(key)) : "-");
  }
  std::string text;
  for (std::string& key : keys) key = platform::printable(key);
  // A single row is easier to read as a column.
  if (cells.size() == 1) {
    std::size_t width = 0;
    for (const std::string& key : keys) width = std::max(width, key.size());
    for (std::size_t c = 0; c < keys.size(); ++c)
      text += keys[c] + std::string(width - keys[c].size() + 2, ' ') + cells[0][c] + "\n";
    return text;
  }
  cells.insert(cells.begin(), keys);
  std::vector<std::size_t> width(keys.size(), 0);
  for (const auto& line : cells)
    for (std::size_t c = 0; c < keys.size(); ++c) width[c] = std::max(width[c], line[c].size());
  for (const auto& line : cells) {
    for (std::size_t c = 0; c < keys.size(); ++c)
      text += std::string(width[c] - line[c].size() + (c ? 2 : 0), ' ') + line[c];
    text += "\n";
  }
  return text;
}

void require_place_of_table(const CommonOptions& options) {
  if (!options.quiet && options.report.empty() && !platform::has_output_stream())
    throw ToolError(
        exit_other,
        "the output stream (stdout) is closed, so the result would be lost; open it, or give --report FILE");
}

void print_table(const CommonOptions& options, const std::string& text, bool in_file) {
  if (options.quiet || (in_file && !platform::has_output_stream())) return;
  platform::print(text);
}

}  // namespace nook::tool
