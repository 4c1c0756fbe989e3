// Describes the contents of a .nook file of each kind in one row: kind, format_version, bytes, sizes, and the
// recipe's entries as recipe_*. Each function throws BAD_FILE or FILE_VERSION for bytes that do not validate.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace nook::tool {

using Row = nlohmann::ordered_json;

// Describes the kind that the bytes name. Throws BAD_FILE for a kind that this version does not know.
Row describe(std::span<const std::byte> bytes);
// The same for lists of many files. Of characters and clips it checks the checksum of the file and reads the
// recipe alone, which takes a hundredth of the time; the row lacks their sizes.
Row describe_briefly(std::span<const std::byte> bytes);
Row describe_character(std::span<const std::byte> bytes);
Row describe_clips(std::span<const std::byte> bytes);
Row describe_network(std::span<const std::byte> bytes);
Row describe_probes(std::span<const std::byte> bytes);
Row describe_material(std::span<const std::byte> bytes);
Row describe_synthesis(std::span<const std::byte> bytes);
Row describe_transfer(std::span<const std::byte> bytes);
Row describe_raw_material(std::span<const std::byte> bytes);
Row describe_recording(std::span<const std::byte> bytes);

// Returns the text of a value that a file holds, or "unknown (N)" for a value that has no text yet.
template <std::size_t count>
std::string text_of(const char* const (&texts)[count], std::size_t value) {
  return value < count ? texts[value] : "unknown (" + std::to_string(value) + ")";
}

// Adds the entries of a recipe, a JSON object, to row. An entry of an object in it becomes object_entry.
// Other text adds nothing.
void add_recipe(Row& row, std::string_view recipe);

}  // namespace nook::tool
