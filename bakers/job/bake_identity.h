// What decides about the bytes of a bake, as canonical text in every baked file, and its key. Two bakes with
// equal text give equal bytes on any machine, but for the names of sources that recipes of probes, materials,
// synthesis and transfer mention. A pipeline compares keys to learn what it has to bake again.
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

// Returns the name in recipes and messages.
const char* name_of(BakeKind kind);

// Returns the generation of a kind of bake. Raise it in bake_identity.cpp when equal inputs begin to give
// other bytes.
int bake_generation(BakeKind kind);

// The text is one line of JSON with sorted keys. It has kind, generation, the versions of Nook, Embree and
// compiler, and the resolved instruction set. It also has hashes of what was read, and every setting. It
// names no file and no machine.
struct BakeIdentity {
  std::string text;

  // Returns the SHA-256 of the text, 64 hexadecimal digits.
  std::string key() const;
};

// settings and inputs are objects. Numbers of threads and names of files do not belong there.
BakeIdentity identify_bake(BakeKind kind, const nlohmann::json& settings, const nlohmann::json& inputs);

// Stores the identity in a recipe, as its entry "bake".
void store_identity(nlohmann::ordered_json& recipe, const BakeIdentity& identity);

// Returns the text of a recipe with an identity; another one in it is replaced. Without an identity the text
// stays as it is.
std::string with_identity(std::string_view recipe_text, const BakeIdentity& identity);

// Returns the identity that a recipe holds; none for files of earlier versions, or text that is not a recipe.
std::optional<BakeIdentity> stored_identity(std::string_view recipe_text);

// Says in what the tool that made a file differs from this one, such as "embree 3.13.4, here 3.13.5". Empty:
// in nothing, so that a bake of equal inputs and settings has the same key.
std::string difference_from_this_tool(const BakeIdentity& identity);

}  // namespace nook::bake
