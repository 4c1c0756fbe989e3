// The identity of a bake contains everything that determines its bytes. Every baked file stores it as
// canonical text. The key is a hash of this text. Two bakes with equal text give equal bytes on any machine.
// The only exception is the names of source files in the recipes of probes, materials, synthesis and
// transfer. A build pipeline compares keys to find out which files it has to bake again.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace nook::bake {

enum class BakeKind : std::uint8_t {
  character,
  calibration,
  bent,
  lod,
  clips,
  probe,
  probe_grid,
  material,
  synthesis,
  transfer
};

// Returns the name of the kind in recipes and messages.
const char* name_of(BakeKind kind);

// Returns the generation of a kind of bake. Increase it in bake_identity.cpp when a code change gives other
// bytes for equal inputs.
int bake_generation(BakeKind kind);

// The text is one line of JSON with sorted keys. It contains the kind, the generation, the versions of Nook,
// Embree and the compiler, and the instruction set that the bake really uses. It also contains hashes of all
// inputs, and every setting. It does not contain names of files or machines.
struct BakeIdentity {
  std::string text;

  // Returns the SHA-256 of the text, 64 hexadecimal digits.
  std::string key() const;
};

// `settings` and `inputs` must be JSON objects. They must not contain thread counts or file names.
BakeIdentity identify_bake(BakeKind kind, const nlohmann::json& settings, const nlohmann::json& inputs);

// Stores the identity in a recipe, under the key "bake".
void store_identity(nlohmann::ordered_json& recipe, const BakeIdentity& identity);

// Returns the text of a recipe with the identity added. Replaces an existing identity. If `identity` is
// empty, returns the text unchanged.
std::string with_identity(std::string_view recipe_text, const BakeIdentity& identity);

// Returns the identity that a recipe contains. Returns nothing if the file is from an earlier version of
// Nook, or if the text is not a recipe.
std::optional<BakeIdentity> stored_identity(std::string_view recipe_text);

// Describes how the tool that made a file differs from this tool, such as "embree 3.13.4, here 3.13.5". If
// the result is empty, this tool computes the same key for a bake with the same inputs and settings.
std::string difference_from_this_tool(const BakeIdentity& identity);

}  // namespace nook::bake
