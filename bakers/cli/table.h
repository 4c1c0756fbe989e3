// The rows of a report as an aligned table on the output stream.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace nook::cli {

// Columns are the keys of the first row, in order. Numbers are right-aligned with three significant digits
// where they are no integers.
std::string table_text(const nlohmann::ordered_json& rows);

// A ratio to nothing, such as an error relative to a black map, is no number: null in reports, "-" in tables.
nlohmann::ordered_json number_or_null(double value);

}  // namespace nook::cli
