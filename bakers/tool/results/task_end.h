// Tells whether a task of a farm failed, from what it left beside the place of its model.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace nook::tool {

// The files of one asset. A path is empty where there is no such file.
struct AssetFiles {
  std::filesystem::path model;   // NAME.nook
  std::filesystem::path report;  // NAME.json, if it is the report of a bake
  std::filesystem::path log;     // of the task, NAME.log
  std::filesystem::path part;    // an unfinished NAME.nook of a bake that runs or was killed
};

// The end of a task's log.
struct TaskEnd {
  std::optional<int> exit_code;  // none: the task still runs, was killed, or another program wrote the log
  std::string words;             // the last line that the task itself said
  bool is_of_task = false;  // `nook task` wrote the log, which then has an end unless the task was killed
};

// The last line of a log says "exit code N".
TaskEnd end_of_log(std::string_view log);

// Returns why a task failed; nothing if it did not. A report, a log or a part without a model is a failure,
// and so is a log that ends in one, or a log of `nook task` without an end. end: of the log, where there is
// one.
std::optional<std::string> failure_of(const AssetFiles& files, const std::optional<TaskEnd>& end);

}  // namespace nook::tool
