#include "bakers/measure/report/overview_rows.h"

#include <algorithm>
#include <cmath>

#include "platform/printable.h"

namespace nook::report {
namespace {

using Json = nlohmann::ordered_json;

// Each row is a JSON array and not an object, because column names in each row would take a third of the
// page.
enum Column {
  name,
  kind,
  state,
  over_limit,
  figure,
  notes,
  bytes,
  seconds,
  key,
  change,
  before,
  flags,
  source,
  log,
  column_count
};
enum Flag : unsigned { has_page = 1, is_linkable = 2, can_have_page = 4 };

// Makes invisible characters visible, so that names that differ only in them look different on the page.
Json shown(const std::string& text) {
  return platform::printable(text);
}

Json rounded(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return Json();
  return std::round(*value * 1e4) / 1e4;
}

unsigned flags_of(const Asset& asset) {
  return (asset.has_page ? has_page : 0u) | (asset.is_linkable ? is_linkable : 0u) |
         (asset.can_have_page ? can_have_page : 0u);
}

Json row_of(const Asset& asset) {
  return Json::array({shown(asset.name), shown(asset.kind), int(asset.state), rounded(asset.over_limit),
                      shown(asset.figure), shown(asset.notes), asset.bytes, rounded(asset.seconds),
                      shown(asset.key), int(asset.change), shown(asset.before), flags_of(asset),
                      shown(asset.source), shown(asset.log)});
}

template <class Names>
Json names_of(std::size_t count, Names&& name_of) {
  Json names = Json::array();
  for (std::size_t i = 0; i < count; ++i) names.push_back(name_of(i));
  return names;
}

bool is_row(const Json& row) {
  if (!row.is_array() || row.size() < column_count) return false;
  for (const Column column : {name, kind, figure, key})
    if (!row[column].is_string()) return false;
  return row[state].is_number_unsigned() && row[state].get<std::uint64_t>() < asset_state_count;
}

// Reads only the columns that a comparison needs.
Asset asset_of(const Json& row) {
  Asset asset;
  asset.name = row[name].get<std::string>();
  asset.kind = row[kind].get<std::string>();
  asset.state = AssetState(row[state].get<std::uint64_t>());
  if (row[over_limit].is_number()) asset.over_limit = row[over_limit].get<double>();
  asset.figure = row[figure].get<std::string>();
  asset.key = row[key].get<std::string>();
  return asset;
}

}  // namespace

Json overview_data(const Overview& overview) {
  Json rows = Json::array();
  for (const Asset& asset : overview.assets) rows.push_back(row_of(asset));
  return {
      {"format", overview_format},
      {"made", overview.made},
      {"folder", shown(overview.folder)},
      {"links", overview.links},
      {"states", names_of(asset_state_count, [](std::size_t i) { return state_name(AssetState(i)); })},
      {"changes", names_of(asset_change_count, [](std::size_t i) { return change_name(AssetChange(i)); })},
      {"rows", std::move(rows)}};
}

std::optional<LastPage> read_overview_page(std::string_view page) {
  const std::string opening =
      std::string("<script type=\"application/json\" id=\"") + overview_data_id + "\">";
  const std::size_t begin = page.find(opening);
  if (begin == std::string_view::npos) return std::nullopt;
  page.remove_prefix(begin + opening.size());
  const Json data = Json::parse(page.substr(0, page.find("</script>")), nullptr, false);
  if (!data.is_object() || data.value("format", Json()) != overview_format) return std::nullopt;
  const Json rows = data.value("rows", Json()), made = data.value("made", Json());
  if (!rows.is_array() || !made.is_string() || !std::ranges::all_of(rows, is_row)) return std::nullopt;
  LastPage last{made.get<std::string>(), {}};
  for (const Json& row : rows) last.assets.push_back(asset_of(row));
  return last;
}

}  // namespace nook::report
