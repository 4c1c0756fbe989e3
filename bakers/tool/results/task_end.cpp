#include "bakers/tool/results/task_end.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace nook::tool {
namespace {

constexpr std::string_view mark = "exit code ";
constexpr std::string_view blanks = " \t\r\n";

// Removes the last line that is not blank, and returns it without surrounding blanks.
std::string_view take_last_line(std::string_view& text) {
  const std::size_t end = text.find_last_not_of(blanks);
  text = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
  const std::size_t begin = text.find_last_of('\n');
  std::string_view line = begin == std::string_view::npos ? text : text.substr(begin + 1);
  text = text.substr(0, text.size() - line.size());
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  return line;
}

std::optional<int> exit_code_in(std::string_view line) {
  const std::size_t at = line.rfind(mark);
  if (at == std::string_view::npos) return std::nullopt;
  const char* const digits = line.data() + at + mark.size();
  int code = 0;
  const auto [end, error] = std::from_chars(digits, line.data() + line.size(), code);
  if (error != std::errc()) return std::nullopt;
  return code;
}

}  // namespace

TaskEnd end_of_log(std::string_view log) {
  const bool is_of_task = log.starts_with("nook task: ");
  const std::string_view last = take_last_line(log);
  TaskEnd end{exit_code_in(last), std::string(last), is_of_task};
  if (end.exit_code)
    if (const std::string_view said = take_last_line(log); !said.empty()) end.words = said;
  return end;
}

std::optional<std::string> failure_of(const AssetFiles& files, const std::optional<TaskEnd>& end) {
  if (end && end->exit_code && *end->exit_code != 0)
    return "exit code " + std::to_string(*end->exit_code) + ": " + end->words;
  const bool has_no_end = end && !end->exit_code;
  if (!files.model.empty() && !(has_no_end && end->is_of_task)) return std::nullopt;
  if (end && !has_no_end) return "its log ends without an error, but there is no model";
  if (has_no_end)
    return "its log is incomplete: the bake still runs, or was killed" +
           (end->words.empty() ? "" : "; last line: " + end->words);
  if (!files.report.empty())
    return "there is a report but no model: the bake ended before it wrote the model";
  return "there is only an unfinished part of a model: the bake still runs, or was killed";
}

}  // namespace nook::tool
