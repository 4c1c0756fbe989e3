// `nook cache prune` removes old results from the folder of --cache.
#include <memory>
#include <optional>

#include "bakers/tool/bake_cache.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/table.h"

namespace nook::tool {
namespace {

struct Options {
  std::filesystem::path cache;
  std::optional<float> days, megabytes;
};

void run(const Options& options) {
  const std::filesystem::path folder = cache_folder(options.cache);
  if (folder.empty())
    throw ToolError(exit_bad_arguments, "cache prune: no folder is given; need --cache DIR or NOOK_CACHE");
  if (!options.days && !options.megabytes)
    throw ToolError(exit_bad_arguments, "cache prune: nothing says what to remove; need --older or --size");
  CacheLimits limits;
  if (options.days) limits.days = double(*options.days);
  if (options.megabytes) limits.bytes = std::uint64_t(double(*options.megabytes) * 1e6);
  const PrunedCache pruned = prune_cache(folder, limits);
  nlohmann::ordered_json row = {{"removed", pruned.removed},
                                {"removed_bytes", pruned.removed_bytes},
                                {"kept", pruned.kept},
                                {"kept_bytes", pruned.kept_bytes}};
  print_table(CommonOptions(), table_text(nlohmann::ordered_json::array({row})), false);
}

}  // namespace

void add_cache_prune(Command cache) {
  const Command command = cache.add_subcommand(
      "prune",
      "remove old results from a cache, or shrink the cache to a given size (--older, --size, or both)");
  const auto options = std::make_shared<Options>();
  command.add_option("--cache", options->cache,
                     "folder of the cache. Default: the folder in the environment variable NOOK_CACHE");
  command
      .add_option("--older", options->days,
                  "remove the results that no bake has used for more than this many days")
      .check(in_range(0.0, 36500.0));
  command
      .add_option("--size", options->megabytes,
                  "remove results until the cache has at most this many MB (10^6 bytes), beginning with the "
                  "result whose last use is longest ago")
      .check(in_range(0.0, 1e9));
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
