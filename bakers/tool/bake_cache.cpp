#include "bakers/tool/bake_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "bakers/import/sha256.h"
#include "bakers/tool/command_end.h"
#include "platform/input_file.h"
#include "platform/printable.h"

namespace nook::tool {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uint64_t max_entry_bytes = std::uint64_t{4} << 30;
constexpr const char* part_mark = ".part-";

void say(const std::string& text) {
  std::fprintf(stderr, "nook: %s\n", platform::printable(text).c_str());
}

fs::path place_of(const fs::path& folder, const std::string& key, const char* extension) {
  return folder / key.substr(0, 2) / (key + extension);
}

std::string host_name() {
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0) return "host";
  std::string safe = name;
  for (char& c : safe)
    if (c == '/') c = '_';
  return safe;
}

// Writes a file under a unique temporary name, then renames it. Throws std::system_error.
void put(const fs::path& place, std::span<const std::byte> bytes) {
  const fs::path part = place.string() + part_mark + host_name() + "-" + std::to_string(getpid());
  const auto fail = [&](int error) {
    unlink(part.c_str());
    throw std::system_error(error, std::generic_category());
  };
  const int descriptor = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category());
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written >= 0)
      bytes = bytes.subspan(std::size_t(written));
    else if (errno != EINTR)
      error = errno;
  }
  // It is not an error if the file system does not support synchronisation.
  if (error == 0 && fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS) error = errno;
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) fail(error);
  if (rename(part.c_str(), place.c_str()) != 0) fail(errno);
}

std::optional<std::vector<std::byte>> bytes_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  try {
    return platform::read_input(path, max_entry_bytes, file_events(true));
  } catch (const platform::Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return std::nullopt;  // another process has just removed it
  }
}

// Returns the result that the two files contain, or nothing if they do not belong together.
std::optional<BakeOutput> checked(const std::vector<std::byte>& entry, std::vector<std::byte> model) {
  const Json json = Json::parse(entry.begin(), entry.end(), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto text = [&](const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  BakeOutput output{std::move(model), text("report"), text("table")};
  const bool fits = text("model_sha256") == bake::sha256(output.file) &&
                    text("text_sha256") == bake::sha256(output.report + '\0' + output.table);
  return fits ? std::optional(std::move(output)) : std::nullopt;
}

// Records that the entry was used now, because pruning removes the least recently used entries. Does nothing
// in a read-only folder.
void note_use(const fs::path& place) {
  utimensat(AT_FDCWD, place.c_str(), nullptr, 0);
}

}  // namespace

fs::path cache_folder(const fs::path& option) {
  if (!option.empty()) return option;
  const char* const from_environment = std::getenv(cache_variable);
  return from_environment ? from_environment : "";
}

BakeCache::BakeCache(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error || !fs::is_directory(folder_))
    throw ToolError(exit_other, "--cache: " + folder_.string() + " cannot be made (" +
                                    (error ? error.message() : "it is a file") + "); choose another folder");
}

std::optional<BakeOutput> BakeCache::find(const std::string& key, bool quiet) const {
  const fs::path model = place_of(folder_, key, ".nook"), entry = place_of(folder_, key, ".json");
  auto model_bytes = bytes_of(model);
  const auto entry_bytes = bytes_of(entry);
  if (!model_bytes || !entry_bytes) return std::nullopt;
  std::optional<BakeOutput> output = checked(*entry_bytes, std::move(*model_bytes));
  if (!output) {
    say(model.string() + " does not match its checksum in the cache; it will be baked again and replaced");
    return std::nullopt;
  }
  note_use(model);
  note_use(entry);
  if (!quiet) say("taken from the cache: " + model.string());
  return output;
}

void BakeCache::store(const std::string& key, const BakeOutput& output) const {
  const Json entry = {{"model_sha256", bake::sha256(output.file)},
                      {"text_sha256", bake::sha256(output.report + '\0' + output.table)},
                      {"report", output.report},
                      {"table", output.table}};
  const std::string text = entry.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  try {
    const fs::path model = place_of(folder_, key, ".nook");
    fs::create_directories(model.parent_path());
    put(place_of(folder_, key, ".json"), std::as_bytes(std::span(text)));
    put(model, output.file);
  } catch (const std::system_error& error) {
    say("--cache: " + folder_.string() + " could not store the result (" + error.code().message() +
        "); the bake itself is complete");
  }
}

namespace {

struct Entry {
  std::vector<fs::path> files;
  std::uint64_t bytes = 0;
  fs::file_time_type used = fs::file_time_type::min();
};

// Removes the model first, because a report without a model is ignored.
void remove_entry(Entry& entry) {
  std::sort(entry.files.begin(), entry.files.end(),
            [](const fs::path& a, const fs::path& b) { return a.extension() > b.extension(); });
  std::error_code error;
  for (const fs::path& file : entry.files)
    fs::remove(file, error);  // another host may have removed it
                              // already
}

bool is_key(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

fs::file_time_type days_ago(double days) {
  using Days = std::chrono::duration<double, std::ratio<86400>>;
  return fs::file_time_type::clock::now() -
         std::chrono::duration_cast<fs::file_time_type::duration>(Days(days));
}

// Returns the entries of a folder by their keys. Also removes abandoned unfinished files.
std::map<std::string, Entry> entries_of(const fs::path& folder) {
  std::map<std::string, Entry> entries;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error), end;
  if (error)
    throw ToolError(exit_other, folder.string() + ": cannot be read (" + error.message() +
                                    "); give the folder of a cache");
  const fs::file_time_type yesterday = days_ago(1);
  for (; at != end; at.increment(error)) {
    if (error) break;
    std::error_code gone;
    const fs::path& path = at->path();
    const std::uint64_t bytes = at->is_regular_file(gone) ? at->file_size(gone) : 0;
    const fs::file_time_type used = fs::last_write_time(path, gone);
    const std::string key = path.filename().string().substr(0, 64);
    if (gone || !at->is_regular_file(gone) || !is_key(key)) continue;
    if (path.filename().string().find(part_mark) != std::string::npos) {
      if (used < yesterday) fs::remove(path, gone);
      continue;
    }
    Entry& entry = entries[key];
    entry.files.push_back(path);
    entry.bytes += bytes;
    entry.used = std::max(entry.used, used);
  }
  return entries;
}

}  // namespace

PrunedCache prune_cache(const fs::path& folder, const CacheLimits& limits) {
  std::vector<Entry> entries;
  for (auto& [key, entry] : entries_of(folder)) entries.push_back(std::move(entry));
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  PrunedCache pruned;
  for (const Entry& entry : entries) pruned.kept_bytes += entry.bytes;
  const fs::file_time_type oldest = limits.days ? days_ago(*limits.days) : fs::file_time_type::min();
  for (Entry& entry : entries) {
    const bool is_old = entry.used < oldest, is_too_much = limits.bytes && pruned.kept_bytes > *limits.bytes;
    if (!is_old && !is_too_much) {
      ++pruned.kept;
      continue;
    }
    remove_entry(entry);
    ++pruned.removed;
    pruned.removed_bytes += entry.bytes;
    pruned.kept_bytes -= entry.bytes;
  }
  return pruned;
}

}  // namespace nook::tool
