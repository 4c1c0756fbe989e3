#include "bakers/tool/inspect/describe.h"

#include <optional>

#include "bakers/job/bake_identity.h"
#include "bakers/job/material_bake.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/recording_file.h"
#include "sdk/src/probe/probe_file.h"
#include "sdk/src/synthesis/coordinates.h"
#include "sdk/src/transfer/transfer_file.h"

namespace nook::tool {
namespace {

struct Kind {
  FourLetters kind;
  Row (*describe)(std::span<const std::byte> bytes);
};
constexpr Kind kinds[] = {{character_kind.kind, describe_character},
                          {clip_kind.kind, describe_clips},
                          {nnao::network_kind.kind, describe_network},
                          {nnao::recording_kind.kind, describe_recording},
                          {probe::probe_kind.kind, describe_probes},
                          {material::material_kind.kind, describe_material},
                          {synthesis::synthesis_kind.kind, describe_synthesis},
                          {transfer::transfer_kind.kind, describe_transfer},
                          {bake::material::raw_kind.kind, describe_raw_material}};

}  // namespace

Row describe(std::span<const std::byte> bytes) {
  const FourLetters found = bytes.size() >= 16 ? container_kind(bytes) : 0;
  for (const Kind& kind : kinds)
    if (kind.kind == found) return kind.describe(bytes);
  if (found != 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "a .nook file of a kind that this version cannot inspect; use a newer version");
  return describe_character(bytes);  // if the bytes are not a .nook file, this throws with the reason
}

Row describe_briefly(std::span<const std::byte> bytes) {
  const FourLetters found = bytes.size() >= 16 ? container_kind(bytes) : 0;
  const ContainerKind* kind = nullptr;
  if (found == character_kind.kind) kind = &character_kind;
  if (found == clip_kind.kind) kind = &clip_kind;
  if (!kind) return describe(bytes);
  const Container container(bytes, *kind);
  Row row{{"kind", kind == &clip_kind ? "clips" : "character model"},
          {"format_version", container.version()},
          {"bytes", bytes.size()}};
  ByteReader recipe = container.section("RECP");
  add_recipe(row, recipe.text(recipe.remaining()));
  return row;
}

namespace {

// Adds the key of the bake, and says whether this tool would make the same file.
void add_identity(Row& row, std::string_view recipe) {
  const std::optional<bake::BakeIdentity> identity = bake::stored_identity(recipe);
  row["key"] = identity ? Row(identity->key()) : Row();
  if (!identity) {
    row["of_this_tool"] = "unknown, because the file was baked before files had keys";
    return;
  }
  const std::string difference = bake::difference_from_this_tool(*identity);
  row["of_this_tool"] = difference.empty() ? "yes" : "no: " + difference;
  const Row stored = Row::parse(identity->text, nullptr, false);
  for (const char* name : {"kind", "generation", "isa", "embree", "compiler"})
    if (stored.contains(name)) row[std::string("bake_") + name] = stored[name];
  if (stored.contains("inputs") && stored["inputs"].is_object())
    for (const auto& input : stored["inputs"].items()) row["input_" + input.key()] = input.value();
}

}  // namespace

void add_recipe(Row& row, std::string_view recipe) {
  const Row entries = Row::parse(recipe, nullptr, false);
  if (!entries.is_object()) return;
  add_identity(row, recipe);
  for (const auto& item : entries.items())
    if (item.key() == "bake" && item.value().is_object())
      continue;
    else if (item.value().is_object())
      for (const auto& part : item.value().items()) row[item.key() + "_" + part.key()] = part.value();
    else
      row["recipe_" + item.key()] = item.value();
}

}  // namespace nook::tool
