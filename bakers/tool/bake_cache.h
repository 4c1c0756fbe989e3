// A folder that keeps the results of bakes by their keys. Several programs on several hosts may share it,
// also over NFS: it has no locks, and every file appears whole by a rename.
//
//   DIR/ab/KEY.json  the report, the table, and the checksums of report, table and model
//   DIR/ab/KEY.nook  the model; ab are the first two digits of KEY
//
// The report is renamed into its place before the model, so that a model is never without its numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bakers/tool/baking.h"

namespace nook::tool {

inline constexpr const char* cache_variable = "NOOK_CACHE";

// Returns the folder that --cache names, else the one in the environment; empty without both.
std::filesystem::path cache_folder(const std::filesystem::path& option);

class BakeCache {
 public:
  // Makes the folder if it does not exist. Throws ToolError.
  explicit BakeCache(std::filesystem::path folder);

  // Returns the result of a key. An entry that does not fit its checksums counts as missing, and the error
  // stream says so. Unless quiet, it also says that a result came from here.
  std::optional<BakeOutput> find(const std::string& key, bool quiet) const;

  // Keeps a result. If it fails, the bake does not: the error stream tells why.
  void store(const std::string& key, const BakeOutput& output) const;

 private:
  std::filesystem::path folder_;
};

struct CacheLimits {
  std::optional<double> days;          // remove what nobody has used for longer
  std::optional<std::uint64_t> bytes;  // then remove what was not used for the longest time, down to this
};

struct PrunedCache {
  std::size_t removed = 0, kept = 0;  // entries
  std::uint64_t removed_bytes = 0, kept_bytes = 0;
};

// Adds nook cache prune.
void add_cache_prune(Command cache);

// Removes entries, and unfinished files that are older than a day. Throws ToolError if the folder cannot be
// read.
PrunedCache prune_cache(const std::filesystem::path& folder, const CacheLimits& limits);

}  // namespace nook::tool
