// Prints the rows of a report as an aligned table on the output stream.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/tool/common_options.h"

namespace nook::tool {

// Columns are the keys of the first row, in order. Numbers are right-aligned. Numbers that are not integers
// have three significant digits.
std::string table_text(const nlohmann::ordered_json& rows);

// Throws ToolError if the result is only shown in the table, but the program has no output stream. Call it
// before the work.
void require_place_of_table(const CommonOptions& options);

// Prints a table, unless the options contain --quiet. Set in_file if a file has the result too. Then nothing
// is lost if there is no output stream. Throws if the table cannot be printed.
void print_table(const CommonOptions& options, const std::string& text, bool in_file);

}  // namespace nook::tool
