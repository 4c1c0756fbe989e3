#include "bakers/measure/report/asset_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bakers/character/judgement.h"
#include "bakers/material/verdict.h"
#include "bakers/measure/report/advice.h"

namespace nook::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* no_report =
    "its error is stored only in the report of its bake, which is missing (bake it with --report)";

// Reads an entry of a JSON object. The entry may be missing or have another type, because the files can come
// from any source.
const Json& entry(const Json& object, const char* name) {
  static const Json none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

std::optional<double> value_of(const Json& object, const char* name) {
  const Json& found = entry(object, name);
  if (!found.is_number() || !std::isfinite(found.get<double>())) return std::nullopt;
  return found.get<double>();
}

std::string text_of(const Json& object, const char* name) {
  const Json& found = entry(object, name);
  return found.is_string() ? found.get<std::string>() : std::string();
}

bool is(const Json& object, const char* name, bool value) {
  const Json& found = entry(object, name);
  return found.is_boolean() && found.get<bool>() == value;
}

std::string shown(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void add(std::string& list, const std::string& words) {
  if (!list.empty()) list += "; ";
  list += words;
}

AssetFigures unmeasured(const std::string& figure) {
  return {AssetState::unmeasured, std::nullopt, figure, {}};
}

AssetFigures measured(double over_limit, const std::string& figure) {
  const AssetState state = over_limit >= bad_over_limit ? AssetState::bad
                           : over_limit > 1             ? AssetState::poor
                                                        : AssetState::good;
  return {state, over_limit, figure, {}};
}

// Returns the first name in a list of the report. In these lists, the worst entry comes first.
std::string first_name(const Json& judged, const char* list) {
  const Json& found = entry(judged, list);
  return found.is_array() && !found.empty() ? text_of(found[0], "name") : std::string();
}

std::string body_words(const Json& judged, double over_static) {
  std::string words = shown(over_static) + " times the error of a static bake";
  if (const auto oracle = value_of(judged, "over_oracle"))
    words += ", " + shown(*oracle) + " times the error of the best static bake";
  if (const auto clip = value_of(judged, "worst_clip_over_static"); clip && *clip > 0) {
    const std::string name = first_name(judged, "clips");
    words += "; worst clip " + (name.empty() ? name : name + " ") + "with " + shown(*clip);
  }
  const std::string part = first_name(judged, "parts");
  return part.empty() ? words : words + "; most of the error is in: " + part;
}

// Returns the judgement from the report. If there is no report, returns the figures that the model stores,
// which do not include body parts and names.
Json judgement_of(const Json& facts, const Json& report) {
  if (entry(report, "judged").is_object()) return report["judged"];
  Json judged = Json::object();
  for (const char* name : {"over_static", "over_oracle", "worst_clip_over_static"})
    if (const auto value = value_of(facts, (std::string("judged_") + name).c_str())) judged[name] = *value;
  return judged;
}

AssetFigures body_figures(const Json& facts, const Json& report) {
  const Json judged = judgement_of(facts, report);
  const auto over_static = value_of(judged, "over_static");
  if (!over_static) return unmeasured("its bake stored no error, because an earlier version of Nook made it");
  AssetFigures figures = measured(*over_static / bake::poor_ratio, body_words(judged, *over_static));
  // A single clip may be worse than a static bake even if the mean over all clips is better.
  if (is(judged, "poor", true) && figures.state == AssetState::good) figures.state = AssetState::poor;
  return figures;
}

AssetFigures level_figures(const Json& facts, const Json&) {
  std::string words = "its error is not stored; measure it with `nook evaluate lods`";
  if (const auto over_static = value_of(facts, "judged_over_static"))
    words += "; the model of its full mesh has " + shown(*over_static) + " times the error of a static bake";
  return unmeasured(words);
}

AssetFigures clip_figures(const Json& facts, const Json& report) {
  const auto error = value_of(report, "error"), limit = value_of(facts, "recipe_max_error");
  if (!error || !limit || *limit <= 0) return unmeasured(no_report);
  return measured(*error / *limit, "AO off by " + shown(*error) + ", asked for " + shown(*limit));
}

// Returns the threshold beyond which the page gives this advice.
double advice_limit(const char* measure, Bound bound) {
  double limit = 0;
  for (const Rule& rule : advice_rules())
    if (rule.subject == Subject::probes && rule.bound == bound && measure == std::string_view(rule.measure))
      limit = rule.threshold;
  return limit;
}

AssetFigures probe_figures(const Json& facts, const Json& report) {
  const auto relative = value_of(report, "irradiance_relative"),
             lowest = value_of(report, "irradiance_minimum");
  AssetFigures figures = unmeasured(no_report);
  if (relative) {
    double over = *relative / advice_limit("irradiance_relative", Bound::at_least);
    if (lowest) over = std::max(over, *lowest / advice_limit("irradiance_minimum", Bound::at_most));
    figures = measured(over, "irradiance off by " + shown(100 * *relative) + " % of its mean" +
                                 (lowest ? ", lowest " + shown(*lowest) : ""));
  }
  if (is(facts, "gloss", false)) {
    figures.notes = "has no gloss amplitudes, so metal may show black patches; bake it again";
    if (figures.state > AssetState::poor) figures.state = AssetState::poor;
  }
  return figures;
}

AssetFigures grid_figures(const Json& facts, const Json& report) {
  const auto error = value_of(facts, "recipe_error"), asked = value_of(facts, "asked_error");
  if (!error) return unmeasured("its bake stored no error");
  std::string words = "statistical error " + shown(100 * *error) + " % of the light";
  AssetFigures figures = asked && *asked > 0
                             ? measured(*error / *asked, words + ", asked for " + shown(100 * *asked) + " %")
                             : unmeasured(words + "; the requested error is not stored");
  if (is(report, "error_reached", false) && figures.state > AssetState::poor)
    figures.state = AssetState::poor;
  return figures;
}

AssetState state_of_verdict(const std::string& verdict, AssetState otherwise) {
  using bake::material::Grade;
  if (verdict == bake::material::grade_name(Grade::bad)) return AssetState::bad;
  if (verdict == bake::material::grade_name(Grade::poor)) return AssetState::poor;
  if (verdict == bake::material::grade_name(Grade::good)) return AssetState::good;
  return otherwise;
}

AssetFigures material_figures(const Json& facts, const Json&) {
  const auto db = value_of(facts, "recipe_held_out_db");
  const std::string words = text_of(facts, "recipe_verdict_words");
  if (!db)
    return unmeasured(words.empty() ? "its bake stored no verdict, because an earlier version of Nook made it"
                                    : words);
  // Converts dB to a ratio of errors. 6 dB less means twice the error.
  AssetFigures figures = measured(std::pow(10.0, (bake::material::good_db - *db) / 20), words);
  figures.state = state_of_verdict(text_of(facts, "recipe_verdict"), figures.state);
  return figures;
}

AssetFigures synthesis_figures(const Json&, const Json& report) {
  const auto seams = value_of(report, "seam_energy"), tiled = value_of(report, "seam_energy_tiled");
  if (!seams || !tiled) return unmeasured(no_report);
  if (*tiled <= 0) return unmeasured("the material tiles without seams");
  return measured(*seams / *tiled, "seams: " + shown(*seams / *tiled) + " times the seams of plain tiling");
}

AssetFigures no_figures(const Json&, const Json&) {
  return unmeasured("its bake does not measure its error; measure it with `nook evaluate`");
}

struct Judge {
  const char* kind;
  AssetFigures (*figures)(const Json& facts, const Json& report);
};
constexpr Judge judges[] = {{"character", body_figures},    {"level of detail", level_figures},
                            {"bent normals", body_figures}, {"clips", clip_figures},
                            {"light probe", probe_figures}, {"probe grid", grid_figures},
                            {"material", material_figures}, {"synthesis", synthesis_figures}};

void add_notes(const Json& facts, std::string& notes) {
  if (text_of(facts, "recipe_preset") == "draft") add(notes, "a draft");
  const std::string tool = text_of(facts, "of_this_tool");
  // Bake farms pin the instruction set, and the program that writes the page may run with another one.
  const bool is_pinned = tool.starts_with("no: isa ") && tool.find(';') == std::string::npos;
  if (tool.starts_with("no: ") && !is_pinned)
    add(notes, "made by another tool: " + tool.substr(4));
  else if (!tool.empty() && tool != "yes" && !is_pinned)
    add(notes, "of this tool: " + tool);
}

}  // namespace

std::string asset_kind(const Json& facts) {
  const std::string kind = text_of(facts, "kind"), bake = text_of(facts, "bake_kind");
  if (kind == "light probe") return value_of(facts, "probes").value_or(1) > 1 ? "probe grid" : "light probe";
  if (kind != "character model") return kind;
  if (bake == "lod") return "level of detail";
  return bake == "bent" ? "bent normals" : "character";
}

AssetFigures asset_figures(const Json& facts, const Json& report) {
  const std::string kind = asset_kind(facts);
  const auto* const judge = std::ranges::find_if(judges, [&](const Judge& j) { return kind == j.kind; });
  AssetFigures figures =
      judge == std::end(judges) ? no_figures(facts, report) : judge->figures(facts, report);
  add_notes(facts, figures.notes);
  return figures;
}

std::optional<double> baking_seconds(const Json& report) {
  if (const auto all = value_of(report, "seconds"))
    return *all + value_of(report, "seconds_source").value_or(0);
  if (!report.is_object()) return std::nullopt;
  std::optional<double> sum;
  for (const auto& item : report.items())
    if (item.key().starts_with("seconds_") && item.value().is_number())
      sum = sum.value_or(0) + item.value().get<double>();
  return sum;
}

std::vector<LimitRow> asset_limits() {
  using namespace bake::material;
  return {{"character, bent normals",
           "visible error on held-out poses, divided by the error of a static bake (judged.over_static)",
           shown(bake::poor_ratio) + ", or one clip that is worse than a static bake"},
          {"clips", "error of the tables against ray tracing", "the value of --max-error"},
          {"light probe", "error of irradiance divided by its mean; lowest irradiance; gloss amplitudes",
           shown(advice_limit("irradiance_relative", Bound::at_least)) + "; " +
               shown(advice_limit("irradiance_minimum", Bound::at_most)) + "; missing"},
          {"probe grid", "statistical error divided by the light", "the value of --error"},
          {"material", "signal-to-error ratio in held-out views and lights, and its verdict",
           shown(good_db) + " dB; bad below " + shown(bad_db) + " dB"},
          {"synthesis", "seams, divided by the seams of plain tiling", "1"}};
}

}  // namespace nook::report
