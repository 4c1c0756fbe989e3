#include "bakers/job/bake_identity.h"

#include <array>

#include "bakers/import/sha256.h"
#include "bakers/raytrace/instruction_set.h"
#include "sdk/src/core/version.h"

namespace nook::bake {
namespace {

using Json = nlohmann::json;  // this type sorts its keys

struct Kind {
  const char* name;
  int generation;
};
// Each entry has the name and the generation of a kind. The entries are in the order of BakeKind.
constexpr std::array kinds{Kind{"character", 6},  Kind{"calibration", 2}, Kind{"bent", 1},
                           Kind{"lod", 2},        Kind{"clips", 2},       Kind{"probe", 1},
                           Kind{"probe-grid", 1}, Kind{"material", 1},    Kind{"synthesis", 1},
                           Kind{"transfer", 1}};
static_assert(kinds.size() == std::size_t(BakeKind::transfer) + 1);

const Kind& kind_of(BakeKind kind) {
  return kinds[std::size_t(kind)];
}

const char* compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

std::string dumped(const Json& json) {
  // Names come from files and may not be UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Returns the part of the identity that depends only on the tool and the kind of bake.
Json tool_of(const std::string& kind) {
  Json tool = {{"nook", version_text},
               {"embree", embree_version()},
               {"compiler", compiler()},
               {"isa", isa_level_name()}};
  for (const Kind& known : kinds)
    if (known.name == kind) tool["generation"] = known.generation;
  return tool;
}

}  // namespace

const char* name_of(BakeKind kind) {
  return kind_of(kind).name;
}

int bake_generation(BakeKind kind) {
  return kind_of(kind).generation;
}

std::string BakeIdentity::key() const {
  return sha256(std::string_view(text));
}

BakeIdentity identify_bake(BakeKind kind, const Json& settings, const Json& inputs) {
  Json identity = tool_of(name_of(kind));
  identity["kind"] = name_of(kind);
  identity["settings"] = settings;
  identity["inputs"] = inputs;
  return {dumped(identity)};
}

void store_identity(nlohmann::ordered_json& recipe, const BakeIdentity& identity) {
  if (!identity.text.empty()) recipe["bake"] = nlohmann::ordered_json::parse(identity.text);
}

std::string with_identity(std::string_view recipe_text, const BakeIdentity& identity) {
  if (identity.text.empty()) return std::string(recipe_text);
  using Ordered = nlohmann::ordered_json;
  Ordered recipe = Ordered::parse(recipe_text, nullptr, false);
  if (!recipe.is_object()) recipe = Ordered::object();
  store_identity(recipe, identity);
  return recipe.dump(-1, ' ', false, Ordered::error_handler_t::replace);
}

std::optional<BakeIdentity> stored_identity(std::string_view recipe_text) {
  const Json recipe = Json::parse(recipe_text, nullptr, false);
  if (!recipe.is_object() || !recipe.contains("bake") || !recipe["bake"].is_object()) return std::nullopt;
  return BakeIdentity{dumped(recipe["bake"])};
}

std::string difference_from_this_tool(const BakeIdentity& identity) {
  const Json stored = Json::parse(identity.text, nullptr, false);
  if (!stored.is_object() || !stored.contains("kind") || !stored["kind"].is_string()) return "damaged";
  const Json tool = tool_of(stored["kind"].get<std::string>());
  std::string text;
  const auto shown = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : dumped(value);
  };
  for (const auto& [name, here] : tool.items()) {
    const Json there = stored.contains(name) ? stored[name] : Json();
    if (there != here)
      text += (text.empty() ? "" : "; ") + name + " " + shown(there) + ", here " + shown(here);
  }
  if (!tool.contains("generation"))
    text += (text.empty() ? "" : "; ") + ("kind " + shown(stored["kind"]) + ", unknown here");
  return text;
}

}  // namespace nook::bake
