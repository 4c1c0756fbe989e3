#include "bakers/measure/report/overview.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

namespace nook::report {
namespace {

// Figures that differ by less than this count as equal.
constexpr double least_change = 0.01;

// Returns how bad a state is, for comparisons. `failed` and `broken` are equally bad, because in both cases
// there is no model to load.
int rank_of(AssetState state) {
  switch (state) {
    case AssetState::failed:
    case AssetState::broken:
      return 3;
    case AssetState::bad:
      return 2;
    case AssetState::poor:
      return 1;
    case AssetState::good:
    case AssetState::unmeasured:
    case AssetState::gone:
      break;
  }
  return 0;
}

AssetChange change_of(const Asset& now, const Asset& before) {
  const int difference = rank_of(now.state) - rank_of(before.state);
  if (difference != 0) return difference > 0 ? AssetChange::worse : AssetChange::better;
  if (now.over_limit && before.over_limit) {
    const double least = least_change * std::max(*now.over_limit, *before.over_limit);
    if (std::fabs(*now.over_limit - *before.over_limit) > least)
      return *now.over_limit > *before.over_limit ? AssetChange::worse : AssetChange::better;
  }
  return now.key != before.key ? AssetChange::other_key : AssetChange::none;
}

std::string words_before(const Asset& now, const Asset& before) {
  std::string words = "was ";
  words += state_name(before.state);
  if (before.over_limit) {
    char shown[40];
    std::snprintf(shown, sizeof shown, ", %.3g of its limit", *before.over_limit);
    words += shown;
  }
  if (now.key != before.key) words += "; other key";
  return words;
}

Asset gone(const Asset& before) {
  Asset asset = before;
  asset.state = AssetState::gone;
  asset.change = AssetChange::gone;
  asset.before = words_before(asset, before);
  asset.has_page = asset.can_have_page = false;
  asset.log.clear();
  asset.bytes = 0;
  asset.seconds.reset();
  asset.notes.clear();
  return asset;
}

}  // namespace

const char* state_name(AssetState state) {
  constexpr const char* names[] = {"failed", "broken", "bad", "poor", "good", "not measured", "gone"};
  static_assert(std::size(names) == asset_state_count);
  return names[std::size_t(state)];
}

const char* change_name(AssetChange change) {
  constexpr const char* names[] = {"same", "new", "worse", "better", "other key", "gone"};
  static_assert(std::size(names) == asset_change_count);
  return names[std::size_t(change)];
}

void mark_changes(std::vector<Asset>& assets, const LastPage& last) {
  std::map<std::string_view, const Asset*> before;
  for (const Asset& asset : last.assets)
    if (asset.state != AssetState::gone) before.emplace(asset.name, &asset);
  for (Asset& asset : assets) {
    const auto found = before.find(asset.name);
    if (found == before.end()) {
      asset.change = AssetChange::fresh;
      continue;
    }
    // A failed bake leaves no file, so its kind is unknown.
    if (asset.kind.empty()) asset.kind = found->second->kind;
    asset.change = change_of(asset, *found->second);
    if (asset.change != AssetChange::none) asset.before = words_before(asset, *found->second);
    before.erase(found);
  }
  for (const auto& [name, asset] : before) assets.push_back(gone(*asset));
}

void sort_worst_first(std::vector<Asset>& assets) {
  std::ranges::sort(assets, {}, [](const Asset& asset) {
    return std::tuple(asset.state, -asset.over_limit.value_or(0), std::string_view(asset.name));
  });
}

}  // namespace nook::report
