// Makes the fixed parts of the page: the totals above the list, the table of limits, and the data for the
// script.
#include <algorithm>
#include <array>

#include "bakers/measure/report/html.h"
#include "bakers/measure/report/overview_rows.h"
#include "sdk/src/core/version.h"

namespace nook::report {
namespace {

struct Sums {
  std::array<std::size_t, asset_state_count> states{};
  std::array<std::size_t, asset_change_count> changes{};
  std::size_t assets = 0;  // number of assets, without those that are gone
  double bytes = 0, seconds = 0;
};

Sums sums_of(const std::vector<Asset>& assets) {
  Sums sums;
  for (const Asset& asset : assets) {
    ++sums.states[std::size_t(asset.state)];
    ++sums.changes[std::size_t(asset.change)];
    if (asset.state == AssetState::gone) continue;
    ++sums.assets;
    sums.bytes += double(asset.bytes);
    sums.seconds += asset.seconds.value_or(0);
  }
  return sums;
}

Html count(std::size_t value) {
  return text(std::to_string(value));
}

Html duration(double seconds) {
  if (seconds < 120) return number(seconds) + Html("&nbsp;s");
  if (seconds < 7200) return number(seconds / 60) + Html("&nbsp;min");
  return number(seconds / 3600) + Html("&nbsp;h");
}

Html lead_of(const Sums& sums) {
  Html lead = count(sums.assets) + (sums.assets == 1 ? Html(" asset: ") : Html(" assets: "));
  bool is_first = true;
  for (std::size_t i = 0; i < asset_state_count; ++i) {
    if (sums.states[i] == 0 || AssetState(i) == AssetState::gone) continue;
    if (!is_first) lead += Html(", ");
    is_first = false;
    lead += count(sums.states[i]) + Html(" ") + text(state_name(AssetState(i)));
  }
  return lead + Html("; ") + byte_count(sums.bytes) + Html(", ") + duration(sums.seconds) +
         Html(" of baking.");
}

Html changes_of(const Overview& overview, const Sums& sums) {
  if (overview.before.empty())
    return Html(
        "There is no earlier page to compare with. The next page that replaces this one will list what "
        "changed.");
  Html words;
  for (std::size_t i = 1; i < asset_change_count; ++i) {
    if (sums.changes[i] == 0) continue;
    if (!words.empty()) words += Html(", ");
    words += count(sums.changes[i]) + Html(" ") + text(change_name(AssetChange(i)));
  }
  return Html("Since the page of ") + text(overview.before) + Html(": ") +
         (words.empty() ? Html("nothing changed") : words) + Html(".");
}

Html limits_of(const std::vector<LimitRow>& limits) {
  std::vector<std::vector<Html>> rows{{Html("kind"), Html("measured value"), Html("poor above")}};
  for (const LimitRow& limit : limits)
    rows.push_back({text(limit.kind), text(limit.figure), text(limit.limit)});
  return table(rows);
}

}  // namespace

std::string overview_page(const Overview& overview) {
  const Sums sums = sums_of(overview.assets);
  const std::string version = version_text;
  return fill("overview.html", {{"title", text(overview.folder)},
                                {"style", fill("style.css", {}) + fill("overview.css", {})},
                                {"lead", lead_of(sums)},
                                {"changes", changes_of(overview, sums)},
                                {"limits", limits_of(overview.limits)},
                                {"made", text(overview.made)},
                                {"version", text(version)},
                                {"id", text(overview_data_id)},
                                {"data", script_data(overview_data(overview))},
                                {"script", fill("overview.js", {})}})
      .code();
}

}  // namespace nook::report
