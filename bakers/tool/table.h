// The rows of a report as an aligned table on the output stream.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/tool/common_options.h"

namespace nook::tool {

// Columns are the keys of the first row, in order. Numbers are right-aligned with three significant digits
// where they are no integers.
std::string table_text(const nlohmann::ordered_json& rows);

// Throws ToolError where the table is the only place of a result, and the program has no output stream. Call
// it before the work.
void require_place_of_table(const CommonOptions& options);

// Prints a table unless the options say --quiet. in_file: a file has the result as well, so that a program
// without an output stream has lost nothing. Throws where the table does not get out.
void print_table(const CommonOptions& options, const std::string& text, bool in_file);

}  // namespace nook::tool
