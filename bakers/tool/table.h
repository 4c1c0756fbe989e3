// The rows of a report as an aligned table on the output stream.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace nook::tool {

// Columns are the keys of the first row, in order. Numbers are right-aligned with three significant digits
// where they are no integers.
std::string table_text(const nlohmann::ordered_json& rows);

}  // namespace nook::tool
