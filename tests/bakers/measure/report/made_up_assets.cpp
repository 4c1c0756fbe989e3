#include "tests/bakers/measure/report/made_up_assets.h"

#include <cstdio>

#include "bakers/measure/report/asset_figures.h"

using namespace nook::report;

namespace {

constexpr const char* kinds[] = {"character", "level of detail", "material", "light probe", "clips"};

std::string name_of(std::size_t i) {
  char name[80];
  std::snprintf(name, sizeof name, "characters/act %zu/crowd/hero_with_a_long_name_%05zu", i % 40, i);
  return i % 500 == 7 ? std::string(name) + "</script><img src=x onerror=\"throw 1\">&'" : name;
}

std::string key_of(std::size_t i) {
  char key[20];
  std::snprintf(key, sizeof key, "%016zx", i * 0x9e3779b97f4a7c15u);
  return key;
}

AssetState state_of(std::size_t i, double over_limit) {
  if (i % 250 == 3) return AssetState::failed;
  if (i % 500 == 4) return AssetState::broken;
  if (i % 5 == 1) return AssetState::unmeasured;
  return over_limit >= bad_over_limit ? AssetState::bad
         : over_limit > 1             ? AssetState::poor
                                      : AssetState::good;
}

}  // namespace

std::vector<Asset> made_up_assets(std::size_t count) {
  std::vector<Asset> assets(count);
  for (std::size_t i = 0; i < count; ++i) {
    Asset& asset = assets[i];
    const double over_limit = double(i * 7919 % 1000) / 400;
    asset.name = name_of(i);
    asset.kind = kinds[i % 5];
    asset.state = state_of(i, over_limit);
    asset.log = asset.name + ".log";
    if (asset.state == AssetState::failed || asset.state == AssetState::broken) {
      asset.notes = "exit code 3: nook: a <mesh> has \"no\" vertices & no bones; export it again";
      continue;
    }
    asset.bytes = 20'000 + i * 37 % 900'000;
    asset.seconds = double(20 + i % 300);
    asset.key = key_of(i);
    asset.can_have_page = true;
    asset.has_page = i % 100 == 0;
    asset.source = asset.name + ".glb";
    asset.figure =
        "0.318 times the error of a static bake, 0.43 times the error of the best static bake; worst clip "
        "Survey with 0.433; most of the error is in: head and neck";
    if (asset.state != AssetState::unmeasured) asset.over_limit = over_limit;
  }
  return assets;
}

Overview made_up_overview(std::size_t count) {
  LastPage last{"2026-11-27 18:00 UTC", made_up_assets(count)};
  for (std::size_t i = 0; i < count; i += 50) last.assets[i].over_limit = 1.5;
  last.assets.resize(count - count / 100);
  last.assets.emplace_back().name = "old/gone";
  Overview overview{"farm/out & <more>", "out/",         "2026-11-28 02:00 UTC",
                    last.made,           asset_limits(), made_up_assets(count)};
  mark_changes(overview.assets, last);
  sort_worst_first(overview.assets);
  return overview;
}
