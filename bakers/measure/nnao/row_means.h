// Rows of reports over several sources: means that leave out what a source lacks, and numbers of tables.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/mean.h"

namespace nook::measure {

// The names of all items, each once, in the order of their first items.
template <typename Item>
std::vector<std::string> distinct_names(std::span<const Item> items, std::string Item::*name) {
  std::vector<std::string> names;
  for (const Item& item : items)
    if (std::ranges::find(names, item.*name) == names.end()) names.push_back(item.*name);
  return names;
}

// null before the first value.
nlohmann::ordered_json mean_or_null(const bake::nnao::Mean& mean);

// The mean of each column over the rows in which it is no null; other members are those of the first row.
// rows: one or more, with all columns.
nlohmann::ordered_json mean_row(std::span<const nlohmann::ordered_json> rows,
                                std::span<const std::string> columns);

// A member by a format of printf for a double; "-" without a number.
std::string table_number(const nlohmann::ordered_json& row, const char* key, const char* format);

}  // namespace nook::measure
