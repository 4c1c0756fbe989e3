// A folder that stores the results of bakes by their keys. Several programs on several hosts may use the same
// folder, also over NFS. The cache needs no locks, because every file is first written completely and then
// renamed to its final name.
//
//   DIR/ab/KEY.json  the report, the table, and the checksums of report, table and model
//   DIR/ab/KEY.nook  the model; ab are the first two digits of KEY
//
// The report gets its final name before the model, so that a model never exists without its report.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bakers/tool/baking.h"

namespace nook::tool {

inline constexpr const char* cache_variable = "NOOK_CACHE";

// Returns the folder that --cache names, or else the folder from the environment variable. Returns an empty
// path if neither is set.
std::filesystem::path cache_folder(const std::filesystem::path& option);

class BakeCache {
 public:
  // Makes the folder if it does not exist. Throws ToolError.
  explicit BakeCache(std::filesystem::path folder);

  // Returns the result that is stored for a key. If an entry does not match its checksums, it is treated as
  // missing, and a message on the error stream says so. Unless `quiet` is true, a message also says when a
  // result was found.
  std::optional<BakeOutput> find(const std::string& key, bool quiet) const;

  // Stores a result. If this fails, a message on the error stream says why, but the bake does not fail.
  void store(const std::string& key, const BakeOutput& output) const;

 private:
  std::filesystem::path folder_;
};

struct CacheLimits {
  std::optional<double> days;          // remove entries that were not used for this many days
  std::optional<std::uint64_t> bytes;  // then remove the least recently used entries until the total size is
                                       // at most this
};

struct PrunedCache {
  std::size_t removed = 0, kept = 0;  // entries
  std::uint64_t removed_bytes = 0, kept_bytes = 0;
};

// Adds the command `nook cache prune`.
void add_cache_prune(Command cache);

// Removes entries, and unfinished files that are older than a day. Throws ToolError if the folder cannot be
// read.
PrunedCache prune_cache(const std::filesystem::path& folder, const CacheLimits& limits);

}  // namespace nook::tool
