// Finds out whether a task on a farm failed, from the files that the task left beside its model.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace nook::tool {

// The files of one asset. A path is empty if there is no such file.
struct AssetFiles {
  std::filesystem::path model;   // NAME.nook
  std::filesystem::path report;  // NAME.json, if it is the report of a bake
  std::filesystem::path log;     // log of the task, NAME.log
  std::filesystem::path part;    // an unfinished NAME.nook; the bake is running or was killed
};

// The end of a task's log.
struct TaskEnd {
  std::optional<int> exit_code;  // none: the task still runs, was killed, or another program wrote the log
  std::string words;             // the last line that the task itself wrote
  // True if `nook task` wrote the log; such a log always has an end, unless the task was killed.
  bool is_of_task = false;
};

// Reads the end of a log. Its last line is "exit code N".
TaskEnd end_of_log(std::string_view log);

// Returns why a task failed, or nothing if it did not fail. A task failed if there is a report, a log or an
// unfinished file, but no model. It also failed if the log ends with a failure, or if `nook task` wrote the
// log and the log has no end. `end` is the end of the log, if there is one.
std::optional<std::string> failure_of(const AssetFiles& files, const std::optional<TaskEnd>& end);

}  // namespace nook::tool
