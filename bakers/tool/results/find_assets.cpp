#include "bakers/tool/results/find_assets.h"

#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bakers/tool/command_end.h"

namespace nook::tool {
namespace {

namespace fs = std::filesystem;

// OutputFile writes NAME.nook.nook-part-PID and renames it.
constexpr std::string_view part_mark = ".nook-part-";

bool is_key(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Removes the extension from the name. Returns false if the name does not have this extension.
bool take_end(std::string& name, std::string_view extension) {
  if (name.size() <= extension.size() || !name.ends_with(extension)) return false;
  name.resize(name.size() - extension.size());
  return true;
}

// Adds one file. Logs and reports may also be named after the model with its extension.
void add_file(const std::string& folder, const fs::path& path, FoundAssets& found) {
  std::string name = path.filename().string();
  fs::path AssetFiles::*member = nullptr;
  if (const std::size_t part = name.rfind(part_mark); part != std::string::npos) {
    name.resize(part);
    if (!take_end(name, ".nook")) return;
    member = &AssetFiles::part;
  } else if (take_end(name, ".nook")) {
    member = &AssetFiles::model;
  } else if (take_end(name, ".json")) {
    member = &AssetFiles::report;
  } else if (take_end(name, ".log")) {
    member = &AssetFiles::log;
  } else {
    return;
  }
  if (member == &AssetFiles::report || member == &AssetFiles::log) {
    take_end(name, ".nook");
    std::error_code error;
    if (fs::is_other(path, error)) return;  // reading a pipe could wait for ever
  }
  if (!is_key(name)) found.assets[folder + name].*member = path;
}

void add_folder(const fs::path& path, const std::string& name, FoundAssets& found) {
  std::error_code error;
  fs::directory_iterator at(path, error), end;
  for (; !error && at != end; at.increment(error)) {
    const std::string entry = at->path().filename().string();
    std::error_code gone;
    if (entry.starts_with('.')) continue;
    if (at->is_directory(gone) && !at->is_symlink(gone))
      add_folder(at->path(), name + entry + "/", found);
    else
      add_file(name, at->path(), found);
  }
  if (error) found.faults[name] = error.message();
}

// A log that `nook plan` keeps. The log of the model ROOT/MODEL is ROOT/BUILD/logs/MODEL.log.
struct PlannedLog {
  std::string name;    // name of the log as an asset
  std::string folder;  // ROOT/BUILD
  std::string model;
};

std::vector<PlannedLog> planned_logs(const FoundAssets& found) {
  constexpr std::string_view logs = "/logs/";
  std::vector<PlannedLog> planned;
  for (const auto& [name, files] : found.assets) {
    const std::size_t at = name.find(logs);
    if (at != std::string::npos && !files.log.empty() && files.model.empty() && files.part.empty())
      planned.push_back({name, name.substr(0, at), name.substr(at + logs.size())});
  }
  return planned;
}

// Removes the last part of a path with a slash at its end.
std::string parent_of(std::string folder) {
  folder.resize(folder.empty() ? 0 : folder.size() - 1);
  const std::size_t slash = folder.rfind('/');
  folder.resize(slash == std::string::npos ? 0 : slash + 1);
  return folder;
}

// Returns ROOT for each folder of a plan. This is the nearest parent folder that contains the model named in
// one of the plan's logs. If no parent folder contains such a model, it is the direct parent folder.
std::map<std::string, std::string> roots_of(const std::vector<PlannedLog>& logs, const FoundAssets& found) {
  std::map<std::string, std::string> roots;
  for (const PlannedLog& log : logs) {
    if (roots.contains(log.folder)) continue;
    for (std::string root = log.folder + "/"; !root.empty();) {
      root = parent_of(root);
      const auto asset = found.assets.find(root + log.model);
      if (asset == found.assets.end() || asset->second.model.empty()) continue;
      roots[log.folder] = root;
      break;
    }
  }
  for (const PlannedLog& log : logs) roots.emplace(log.folder, parent_of(log.folder + "/"));
  return roots;
}

// Assigns the logs in the folders of plans to their assets.
void place_logs(FoundAssets& found) {
  const std::vector<PlannedLog> logs = planned_logs(found);
  const std::map<std::string, std::string> roots = roots_of(logs, found);
  for (const PlannedLog& log : logs) {
    AssetFiles& files = found.assets[log.name];
    found.assets[roots.at(log.folder) + log.model].log = std::exchange(files.log, {});
    if (files.report.empty()) found.assets.erase(log.name);
  }
}

}  // namespace

FoundAssets find_assets(const fs::path& folder) {
  FoundAssets found;
  add_folder(folder, "", found);
  if (const auto fault = found.faults.find(""); fault != found.faults.end())
    throw ToolError(exit_bad_input,
                    "--all: " + folder.string() + " cannot be read (" + fault->second + "); give a folder");
  place_logs(found);
  return found;
}

}  // namespace nook::tool
