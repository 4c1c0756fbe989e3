// Describes the contents of a .nook file of each kind in one row: kind, format_version, bytes, sizes, and the
// recipe's entries as recipe_*. Each function throws BAD_FILE or FILE_VERSION for invalid bytes.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace nook::tool {

using Row = nlohmann::ordered_json;

// Describes a file of any kind. The kind is read from the bytes. Throws BAD_FILE for a kind that this version
// does not know.
Row describe(std::span<const std::byte> bytes);
// A faster version for lists of many files. For characters and clips, it only checks the checksum of the file
// and reads the recipe. This takes a hundredth of the time, but the rows do not contain sizes.
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

// Returns the text for a value in a file, or "unknown (N)" for a value without a text.
template <std::size_t count>
std::string text_of(const char* const (&texts)[count], std::size_t value) {
  return value < count ? texts[value] : "unknown (" + std::to_string(value) + ")";
}

// Adds the entries of a recipe, which is a JSON object, to `row`. An entry of a nested object gets the key
// object_entry. If the text is not a JSON object, adds nothing.
void add_recipe(Row& row, std::string_view recipe);

}  // namespace nook::tool
