#include "bakers/tool/plan/reasons.h"

#include <algorithm>
#include <filesystem>

#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

// Returns the names of the entries that differ between two objects.
std::string differing(const Json& there, const Json& here) {
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  const auto in = [](const Json& json, const std::string& name) {
    return json.is_object() && json.contains(name) ? json[name] : Json();
  };
  for (const auto& item : here.items())
    if (in(there, item.key()) != item.value()) add(item.key());
  if (there.is_object())
    for (const auto& item : there.items())
      if (!here.contains(item.key())) add(item.key());
  return names;
}

void add(std::string& reasons, const std::string& reason) {
  reasons += (reasons.empty() ? "" : "; ") + reason;
}

// Reads the duration from the row of a report. It is "seconds", or the sum of one entry per stage.
double seconds_in(const Json& row) {
  double seconds = 0;
  if (row.contains("seconds") && row["seconds"].is_number()) return row["seconds"].get<double>();
  for (const auto& item : row.items())
    if (item.key().starts_with("seconds") && item.value().is_number()) seconds += item.value().get<double>();
  return seconds;
}

double reported_s(const std::string& report) {
  std::error_code error;
  if (!fs::is_regular_file(report, error)) return 0;
  try {
    const std::vector<std::byte> bytes = read_any_file(report);
    const char* const text = reinterpret_cast<const char*>(bytes.data());
    const Json json = Json::parse(text, text + bytes.size(), nullptr, false);
    if (!json.is_object()) return 0;
    const bool has_rows = json.contains("rows") && json["rows"].is_array() && !json["rows"].empty();
    const Json& row = has_rows ? json["rows"][0] : json;
    return row.is_object() ? seconds_in(row) : 0;
  } catch (const ToolError&) {
    return 0;
  }
}

// Returns the typical time for an input file of one megabyte.
double typical_s(const Job& job) {
  if (job.kind == "lod" || job.kind == "bent") return 10;
  if (job.kind == "clips") return 30;
  if (job.kind != "character") return 60;
  if (job.preset == "draft") return 20;
  return job.preset == "production" ? 1200 : 180;
}

}  // namespace

std::string reason_of(const Job& job, const std::string& identity, const std::string& there, bool exists,
                      bool was_there) {
  if (!exists) return was_there ? "its output no longer exists" : "new";
  if (there.empty())
    return "the output has no key, because an earlier version baked it or it is not a baked file";
  const Json old = Json::parse(there, nullptr, false), now = Json::parse(identity, nullptr, false);
  if (!old.is_object() || !now.is_object()) return "the key in its output is damaged";
  std::string reasons;
  const std::string inputs = differing(old.value("inputs", Json()), now["inputs"]);
  if (!inputs.empty()) add(reasons, "input changed: " + job.source + " (" + inputs + ")");
  const std::string settings = differing(old.value("settings", Json()), now["settings"]);
  if (!settings.empty()) add(reasons, "options changed: " + settings);
  const std::string tool = bake::difference_from_this_tool({there});
  if (!tool.empty()) add(reasons, "other tool: " + tool);
  return reasons.empty() ? "its output comes from another kind of bake" : reasons;
}

double estimate_s(const Job& job, const std::vector<StampedFile>& read) {
  if (const double reported = reported_s(report_of(job.output)); reported > 0) return reported;
  double bytes = 0;
  for (const StampedFile& file : read) bytes += double(std::max<std::int64_t>(file.stamp.bytes, 0));
  return typical_s(job) * std::clamp(bytes / 1e6, 0.1, 4.0);
}

}  // namespace nook::tool::plan
