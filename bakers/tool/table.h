// Prints the rows of a report as an aligned table on the output stream.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/tool/common_options.h"

namespace nook::tool {

// Columns are the keys of the first row, in order. Numbers are right-aligned. Numbers that are not integers
// have three significant digits.
std::string table_text(const nlohmann::ordered_json& rows);

// Throws ToolError if the options ask for no report file and the program has no output stream, because the
// table would then be lost. Call this before the work begins.
void require_place_of_table(const CommonOptions& options);

// Prints a table, unless the options contain --quiet. Set in_file if a file also contains the result, so that
// a missing output stream is not an error. Throws if the table cannot be printed.
void print_table(const CommonOptions& options, const std::string& text, bool in_file);

}  // namespace nook::tool
