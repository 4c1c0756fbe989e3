#include "bakers/measure/nnao/row_means.h"

#include <cstdio>

namespace nook::measure {

using Json = nlohmann::ordered_json;
using bake::nnao::Mean;

Json mean_or_null(const Mean& mean) {
  return mean.count > 0 ? Json(mean.value()) : Json();
}

Json mean_row(std::span<const Json> rows, std::span<const std::string> columns) {
  Json row = rows.front();
  for (const std::string& column : columns) {
    Mean mean;
    for (const Json& of_source : rows)
      if (!of_source[column].is_null()) mean.add(of_source[column].get<double>());
    row[column] = mean_or_null(mean);
  }
  return row;
}

std::string table_number(const Json& row, const char* key, const char* format) {
  if (!row.contains(key) || !row[key].is_number()) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, row[key].get<double>());
  return text;
}

}  // namespace nook::measure
