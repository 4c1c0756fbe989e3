#include "bakers/tool/results/read_asset.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>

#include "bakers/measure/report/asset_figures.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/inspect/describe.h"
#include "platform/input_file.h"
#include "platform/printable.h"

namespace nook::tool {
namespace {

namespace fs = std::filesystem;

// Limits the length of texts, so that a page of 5,000 rows stays small.
constexpr std::size_t most_words = 400;
// Enough digits to distinguish keys.
constexpr std::size_t key_digits = 16;
// The report of a long bake has about 100 kB. Larger JSON files are not reports.
constexpr std::uintmax_t most_report_bytes = 16u << 20;

std::string cut(std::string text) {
  if (text.size() <= most_words) return text;
  std::size_t end = most_words;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
    --end;  // do not cut a UTF-8 character
  return text.substr(0, end) + "...";
}

void add(std::string& list, const std::string& words) {
  if (words.empty()) return;
  if (!list.empty()) list += "; ";
  list += words;
}

// Removes the path from a message of read_any_file, because the row already shows it.
std::string without_path(std::string text, const fs::path& path) {
  const std::string begin = path.string() + ": ";
  return text.starts_with(begin) ? text.substr(begin.size()) : text;
}

// Returns the row of a bake's report, or null for JSON of another kind. The report of a character is the row
// itself.
Row row_of_report(const Row& json) {
  const Row* row = &json;
  if (json.is_object() && json.contains("rows")) {
    if (!json["rows"].is_array() || json["rows"].size() != 1) return Row();
    row = &json["rows"][0];
  }
  const auto has = [&](const char* name) { return row->is_object() && row->contains(name); };
  const bool is_probe = has("bytes") && (has("map") || has("scene")) && has("functions");
  return has("model_bytes") || has("file_bytes") || is_probe ? *row : Row();
}

// Returns the size of the model that a report describes.
std::optional<std::uint64_t> reported_bytes(const Row& row) {
  for (const char* name : {"model_bytes", "file_bytes", "bytes"})
    if (row.contains(name) && row[name].is_number_unsigned()) return row[name].get<std::uint64_t>();
  return std::nullopt;
}

// Returns the source file that `nook report` needs for a page of this kind, if it lies beside the model.
std::string source_of(const fs::path& folder, const std::string& name, const std::string& kind) {
  const bool is_probe = kind == "light probe";
  if (!is_probe && kind != "character" && kind != "level of detail" && kind != "bent normals" &&
      kind != "radiance transfer")
    return "";
  std::error_code error;
  for (const char* extension : {".glb", ".gltf", ".hdr", ".exr"}) {
    const bool is_map = extension == std::string_view(".hdr") || extension == std::string_view(".exr");
    if (is_map == is_probe && fs::exists(folder / (name + extension), error)) return name + extension;
  }
  return is_probe ? "" : "?";
}

bool can_have_page(const std::string& kind) {
  constexpr const char* kinds[] = {
      "character",  "level of detail", "bent normals",      "light probe",
      "probe grid", "material",        "radiance transfer", "recorded frame of the screen-space pass"};
  return std::ranges::any_of(kinds, [&](const char* known) { return kind == known; });
}

class Reader {
 public:
  Reader(const fs::path& folder, const std::string& name, AssetFiles files)
      : folder_(folder), files_(std::move(files)) {
    asset_.name = platform::printable(name);
    asset_.is_linkable = asset_.name == name;
    std::error_code error;
    asset_.has_page = fs::exists(folder / (name + ".html"), error);
    const std::string log = files_.log.lexically_relative(folder).generic_string();
    if (platform::printable(log) == log) asset_.log = log;
    read_report();
    read_log();
    if (!files_.model.empty()) read_model(name);
  }

  std::optional<report::Asset> result() {
    if (files_.model.empty() && files_.report.empty() && files_.log.empty() && files_.part.empty())
      return std::nullopt;
    if (const std::optional<std::string> failure = failure_of(files_, end_)) {
      asset_.state = report::AssetState::failed;
      asset_.notes = *failure;
    }
    asset_.notes = cut(asset_.notes);
    asset_.figure = cut(asset_.figure);
    return std::move(asset_);
  }

 private:
  std::vector<std::byte> bytes_of(const fs::path& path, const char* what) {
    try {
      return read_any_file(path);
    } catch (const platform::Stopped&) {
      throw;
    } catch (const std::runtime_error& error) {
      add(asset_.notes, std::string(what) + " cannot be read: " + without_path(error.what(), path));
      return {};
    }
  }

  // A JSON file that is not a report does not show that a bake ran.
  void read_report() {
    if (files_.report.empty()) return;
    std::error_code error;
    if (fs::file_size(files_.report, error) <= most_report_bytes || error) {
      const std::vector<std::byte> bytes = bytes_of(files_.report, "its report");
      const char* const text = reinterpret_cast<const char*>(bytes.data());
      const Row json = Row::parse(text, text + bytes.size(), nullptr, false);
      if (json.is_discarded() && !bytes.empty()) add(asset_.notes, "its report is not JSON");
      report_ = row_of_report(json);
    }
    if (report_.is_null()) files_.report.clear();
  }

  void read_log() {
    if (files_.log.empty()) return;
    const std::vector<std::byte> bytes = bytes_of(files_.log, "its log");
    end_ = end_of_log({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  // If the size in the report differs from the model's size, the report belongs to another bake and must not
  // be used to judge this model.
  void drop_other_report() {
    if (report_.is_null() || reported_bytes(report_).value_or(asset_.bytes) == asset_.bytes) return;
    add(asset_.notes, "its report belongs to another bake");
    report_ = Row();
  }

  void read_model(const std::string& name) {
    try {
      std::error_code error;
      if (fs::is_other(files_.model, error)) throw std::runtime_error("is not a regular file");
      const std::vector<std::byte> bytes = read_file(files_.model);
      asset_.bytes = bytes.size();
      drop_other_report();
      judge(describe_briefly(bytes), name);
    } catch (const platform::Stopped&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      asset_.state = report::AssetState::broken;
      add(asset_.notes, without_path(error.what(), files_.model));
    }
  }

  void judge(const Row& facts, const std::string& name) {
    const report::AssetFigures figures = report::asset_figures(facts, report_);
    asset_.kind = report::asset_kind(facts);
    asset_.state = figures.state;
    asset_.over_limit = figures.over_limit;
    asset_.figure = figures.figure;
    add(asset_.notes, figures.notes);
    asset_.seconds = report::baking_seconds(report_);
    const auto key = facts.find("key");
    if (key != facts.end() && key->is_string()) asset_.key = key->get<std::string>().substr(0, key_digits);
    asset_.can_have_page = can_have_page(asset_.kind);
    asset_.source = source_of(folder_, name, asset_.kind);
  }

  const fs::path& folder_;
  AssetFiles files_;
  Row report_;
  std::optional<TaskEnd> end_;
  report::Asset asset_;
};

}  // namespace

std::optional<report::Asset> read_asset(const fs::path& folder, const std::string& name, AssetFiles files) {
  return Reader(folder, name, std::move(files)).result();
}

}  // namespace nook::tool
