#include "bakers/measure/report/asset_figures.h"

#include "tests/catch.h"

using namespace nook::report;
using Json = nlohmann::ordered_json;

namespace {

const Json body{{"kind", "character model"},
                {"bake_kind", "character"},
                {"judged_over_static", 0.2},
                {"judged_over_oracle", 0.3},
                {"judged_worst_clip_over_static", 0.4}};

Json with(Json json, const char* name, const Json& value) {
  json[name] = value;
  return json;
}

Json judged(double over_static, bool poor) {
  return {{"judged",
           {{"over_static", over_static},
            {"over_oracle", 0.4},
            {"worst_clip_over_static", 1.2},
            {"poor", poor},
            {"clips", {{{"name", "Run"}}}},
            {"parts", {{{"name", "head"}}}}}}};
}

}  // namespace

TEST_CASE("a character is judged by its share of a static bake's error") {
  const AssetFigures stored = asset_figures(body, {});
  CHECK(stored.state == AssetState::good);
  CHECK(*stored.over_limit == Approx(0.8));  // 0.25 is poor
  CHECK(stored.figure ==
        "0.2 times the error of a static bake, 0.3 times the error of the best static bake; worst clip with "
        "0.4");
  const AssetFigures reported = asset_figures(body, judged(0.3, true));
  CHECK(reported.state == AssetState::poor);
  CHECK(reported.figure.find("worst clip Run with 1.2; most of the error is in: head") != std::string::npos);
  CHECK(asset_figures(body, judged(0.6, true)).state == AssetState::bad);
  // One clip is worse than a static bake, all together are not.
  CHECK(asset_figures(body, judged(0.2, true)).state == AssetState::poor);
  CHECK(asset_figures({{"kind", "character model"}}, {}).state == AssetState::unmeasured);
}

TEST_CASE("levels of detail have no error of their own") {
  const Json level = with(body, "bake_kind", "lod");
  CHECK(asset_kind(level) == "level of detail");
  CHECK(asset_figures(level, {}).state == AssetState::unmeasured);
  CHECK(asset_figures(level, {}).figure.find("0.2 times the error of a static bake") != std::string::npos);
  CHECK(asset_kind(with(body, "bake_kind", "bent")) == "bent normals");
}

TEST_CASE("a material is judged by its verdict") {
  const auto figures = [](double db, const char* verdict) {
    return asset_figures({{"kind", "material"},
                          {"recipe_held_out_db", db},
                          {"recipe_verdict", verdict},
                          {"recipe_verdict_words", "words"}},
                         {});
  };
  CHECK(figures(24, "good").state == AssetState::good);
  CHECK(*figures(18, "good").over_limit == Approx(1));
  CHECK(figures(15, "poor").state == AssetState::poor);
  CHECK(figures(8, "bad").state == AssetState::bad);
  CHECK(figures(8, "bad").figure == "words");
  CHECK(asset_figures({{"kind", "material"}, {"recipe_verdict", "not judged"}}, {}).state ==
        AssetState::unmeasured);
}

TEST_CASE("probes are judged by their light, their darkest place and their gloss") {
  const Json probe{{"kind", "light probe"}, {"probes", 1}, {"gloss", true}};
  CHECK(asset_figures(probe, {}).state == AssetState::unmeasured);
  CHECK(asset_figures(probe, {{"irradiance_relative", 0.05}}).state == AssetState::good);
  CHECK(*asset_figures(probe, {{"irradiance_relative", 0.05}}).over_limit == Approx(0.5));
  CHECK(asset_figures(probe, {{"irradiance_relative", 0.15}}).state == AssetState::poor);
  CHECK(asset_figures(probe, {{"irradiance_relative", 0.05}, {"irradiance_minimum", -0.03}}).state ==
        AssetState::poor);
  const Json old = with(probe, "gloss", false);
  CHECK(asset_figures(old, {{"irradiance_relative", 0.05}}).state == AssetState::poor);
  CHECK(asset_figures(old, {{"irradiance_relative", 0.3}}).state == AssetState::bad);
}

TEST_CASE("grids and clips are judged by what was asked for") {
  const Json grid{{"kind", "light probe"}, {"probes", 8}, {"recipe_error", 0.02}, {"asked_error", 0.01}};
  CHECK(asset_kind(grid) == "probe grid");
  CHECK(*asset_figures(grid, {}).over_limit == Approx(2));
  const Json old = with(grid, "asked_error", nullptr);
  CHECK(asset_figures(old, {}).state == AssetState::unmeasured);
  CHECK(asset_figures(old, {{"error_reached", false}}).state == AssetState::poor);
  const Json clips{{"kind", "clips"}, {"recipe_max_error", 0.02}};
  CHECK(*asset_figures(clips, {{"error", 0.01}}).over_limit == Approx(0.5));
  CHECK(asset_figures(clips, {}).figure.find("--report") != std::string::npos);
}

TEST_CASE("notes name drafts and files of other tools") {
  Json draft = with(body, "recipe_preset", "draft");
  draft["of_this_tool"] = "no: embree 3.13.4, here 3.13.5";
  CHECK(asset_figures(draft, {}).notes == "a draft; made by another tool: embree 3.13.4, here 3.13.5");
  draft["of_this_tool"] = "no: isa x86-64-v3, here x86-64-v4";
  CHECK(asset_figures(draft, {}).notes == "a draft");
  draft["of_this_tool"] = "no: isa x86-64-v3, here x86-64-v4; nook 1.0, here 1.1";
  CHECK(asset_figures(draft, {}).notes.find("made by another tool: isa") != std::string::npos);
}

TEST_CASE("hostile figures are not figures") {
  CHECK(asset_figures(with(body, "judged_over_static", "0.2"), {}).state == AssetState::unmeasured);
  CHECK(asset_figures(body, Json::array({1})).state == AssetState::good);
  CHECK(asset_figures(body, {{"judged", {{"over_static", {}}, {"clips", 7}}}}).state ==
        AssetState::unmeasured);
}

TEST_CASE("a bake took what its report says") {
  CHECK(*baking_seconds({{"seconds", 2.0}, {"seconds_source", 1.0}, {"seconds_raytrace", 9.0}}) == 3);
  CHECK(*baking_seconds({{"seconds_raytrace", 1.0}, {"seconds_fit", 2.0}}) == 3);
  CHECK_FALSE(baking_seconds({{"bytes", 1}}));
  CHECK_FALSE(baking_seconds({}));
}
