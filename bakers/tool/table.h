// Prints the rows of a report as an aligned table on the output stream.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/tool/common_options.h"

namespace nook::tool {

// Columns are the keys of the first row, in order. Numbers are right-aligned. Numbers that are not integers
// have three significant digits.
std::string table_text(const nlohmann::ordered_json& rows);

// Throws ToolError if the table is the only place of a result and the program has no output stream. Call it
// before the work.
void require_place_of_table(const CommonOptions& options);

// Prints a table unless the options say --quiet. in_file: a file has the result as well, so that nothing is
// lost without an output stream. Throws if the table cannot be printed.
void print_table(const CommonOptions& options, const std::string& text, bool in_file);

}  // namespace nook::tool
