#include "bakers/measure/report/overview.h"

#include <algorithm>
#include <ctime>
#include <string>

#include "tests/bakers/measure/report/made_up_assets.h"
#include "tests/catch.h"

using namespace nook::report;

namespace {

Asset asset_of(const char* name, AssetState state, std::optional<double> over_limit = {},
               const char* key = "k") {
  Asset asset;
  asset.name = name;
  asset.kind = "character";
  asset.state = state;
  asset.over_limit = over_limit;
  asset.key = key;
  return asset;
}

const Asset& named(const std::vector<Asset>& assets, const std::string& name) {
  const auto found = std::ranges::find(assets, name, &Asset::name);
  REQUIRE(found != assets.end());
  return *found;
}

}  // namespace

TEST_CASE("assets stand by state, then by the visible error, then by name") {
  std::vector<Asset> assets{
      asset_of("gone", AssetState::gone, 9),          asset_of("b", AssetState::good, 0.5),
      asset_of("unmeasured", AssetState::unmeasured), asset_of("a", AssetState::good, 0.5),
      asset_of("worse", AssetState::good, 0.9),       asset_of("poor", AssetState::poor, 0.8),
      asset_of("bad", AssetState::bad, 2.5),          asset_of("broken", AssetState::broken),
      asset_of("failed", AssetState::failed)};
  sort_worst_first(assets);
  std::vector<std::string> names;
  for (const Asset& asset : assets) names.push_back(asset.name);
  CHECK(names ==
        std::vector<std::string>{"failed", "broken", "bad", "poor", "worse", "a", "b", "unmeasured", "gone"});
}

TEST_CASE("a page tells what changed since the last one") {
  const LastPage last{"then",
                      {asset_of("same", AssetState::good, 0.5), asset_of("better", AssetState::good, 0.5),
                       asset_of("worse", AssetState::good, 0.5), asset_of("noise", AssetState::good, 0.5),
                       asset_of("key", AssetState::good, 0.5), asset_of("cured", AssetState::failed),
                       asset_of("fails", AssetState::good, 0.5), asset_of("lost", AssetState::poor, 1.5),
                       asset_of("long gone", AssetState::gone)}};
  std::vector<Asset> now{
      asset_of("same", AssetState::good, 0.5),         asset_of("better", AssetState::good, 0.4),
      asset_of("worse", AssetState::poor, 1.1),        asset_of("noise", AssetState::good, 0.504),
      asset_of("key", AssetState::good, 0.5, "other"), asset_of("cured", AssetState::good, 0.5),
      asset_of("fails", AssetState::failed),           asset_of("new", AssetState::good, 0.5)};
  now[6].kind.clear();
  mark_changes(now, last);
  CHECK(now.size() == 9);
  for (const auto& [name, change] :
       std::vector<std::pair<const char*, AssetChange>>{{"same", AssetChange::none},
                                                        {"better", AssetChange::better},
                                                        {"worse", AssetChange::worse},
                                                        {"noise", AssetChange::none},
                                                        {"key", AssetChange::other_key},
                                                        {"cured", AssetChange::better},
                                                        {"fails", AssetChange::worse},
                                                        {"new", AssetChange::fresh},
                                                        {"lost", AssetChange::gone}}) {
    INFO(name);
    CHECK(named(now, name).change == change);
  }
  CHECK(named(now, "worse").before == "was good, 0.5 of its limit");
  // A failed bake left nothing that tells its kind, but the last page knows it.
  CHECK(named(now, "fails").kind == "character");
  CHECK(named(now, "lost").state == AssetState::gone);
}

TEST_CASE("the next page reads what a page holds") {
  const Overview overview = made_up_overview(300);
  const std::optional<LastPage> last = read_overview_page(overview_page(overview));
  REQUIRE(last);
  CHECK(last->made == overview.made);
  REQUIRE(last->assets.size() == overview.assets.size());
  std::vector<Asset> same = made_up_assets(300);
  mark_changes(same, *last);
  // Figures keep four digits in a page, and changes below a hundredth do not count.
  CHECK(std::ranges::all_of(same, [](const Asset& asset) { return asset.change == AssetChange::none; }));
}

TEST_CASE("what is no page of this kind is not compared") {
  const std::string page = overview_page(made_up_overview(300));
  const auto with = [&](const std::string& old, const std::string& put) {
    std::string changed = page;
    const std::size_t at = changed.find(old);
    REQUIRE(at != std::string::npos);
    return changed.replace(at, old.size(), put);
  };
  CHECK_FALSE(read_overview_page(""));
  CHECK_FALSE(read_overview_page("<!doctype html><p>else</p>"));
  CHECK_FALSE(read_overview_page(page.substr(0, page.size() / 2)));
  CHECK_FALSE(read_overview_page(with("\"format\":1", "\"format\":2")));
  CHECK_FALSE(read_overview_page(with("\"rows\":[[\"", "\"rows\":[[7,\"")));
  CHECK_FALSE(read_overview_page(with("\"rows\":[", "\"rows\":[[],")));
}

TEST_CASE("no text of an asset becomes markup") {
  const std::string page = overview_page(made_up_overview(300));
  CHECK(page.find("<img") == std::string::npos);
  CHECK(page.find("<more>") == std::string::npos);
  CHECK(page.find("onerror=\"") == std::string::npos);
  CHECK(page.find("{{") == std::string::npos);
  // Each script ends where the template ends it: the data, and the code.
  std::size_t ends = 0;
  for (std::size_t at = 0; (at = page.find("</script>", at)) != std::string::npos; ++at) ++ends;
  CHECK(ends == 2);
}

TEST_CASE("a page of 5,000 assets is small and made at once") {
  const std::clock_t began = std::clock();
  const std::string page = overview_page(made_up_overview(5000));
  const double seconds = double(std::clock() - began) / CLOCKS_PER_SEC;
  INFO(page.size() << " bytes, " << seconds << " s");
  // 10 MB open at once on a phone. Reading 5,000 files may take the rest of ten seconds.
  CHECK(page.size() < 10'000'000);
  CHECK(seconds < 5);
}
