#include "sdk/src/character/bone_names.h"

#include <algorithm>
#include <string_view>

namespace nook {
namespace {

constexpr std::string_view separators = "._-:|";

std::string_view text_of(const char* text) {
  return text ? std::string_view(text) : std::string_view();
}

std::string_view without(std::string_view name, std::string_view prefix, std::string_view suffix) {
  if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  if (name.ends_with(suffix)) name.remove_suffix(suffix.size());
  return name;
}

// The number of characters that all names begin with, up to and with their last separator. A single name has
// nothing in common with others.
std::size_t shared_prefix(std::span<const std::string_view> names) {
  if (names.size() < 2) return 0;
  std::string_view shared = names[0];
  for (const std::string_view name : names) {
    const auto differs = std::mismatch(shared.begin(), shared.end(), name.begin(), name.end()).first;
    shared = shared.substr(0, static_cast<std::size_t>(differs - shared.begin()));
  }
  const std::size_t last = shared.find_last_of(separators);
  return last == std::string_view::npos ? 0 : last + 1;
}

using Names = Vector<std::string_view>;

void drop_shared_prefix(Names& names, Memory* memory) {
  Names given(memory);
  for (const std::string_view name : names)
    if (!name.empty()) given.push_back(name);
  const std::size_t shared = shared_prefix(given);
  for (std::string_view& name : names)
    if (!name.empty()) name.remove_prefix(shared);
}

// The form in which names are compared.
String key_of(std::string_view name, bool is_loose, Memory* memory) {
  String key(memory);
  for (const char c : name) {
    if (is_loose && (c == ' ' || separators.find(c) != std::string_view::npos)) continue;
    key += is_loose && c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return key;
}

struct KeyedIndex {
  String key;
  std::int32_t index;
};

}  // namespace

std::size_t map_bones(const CharacterModel& model, const nook_bone_map_desc& names,
                      std::span<std::int32_t> transform_of_bone, Memory* memory) {
  Names host(memory), own(memory);
  for (std::uint32_t i = 0; i < names.name_count; ++i)
    host.push_back(without(text_of(names.names[i]), text_of(names.host_prefix), text_of(names.host_suffix)));
  for (const String& name : model.bone_names)
    own.push_back(without(name, text_of(names.model_prefix), text_of(names.model_suffix)));
  if (names.flags & NOOK_BONE_MAP_DROP_SHARED_PREFIX) {
    drop_shared_prefix(host, memory);
    drop_shared_prefix(own, memory);
  }
  const bool is_loose = names.flags & NOOK_BONE_MAP_LOOSE;
  Vector<KeyedIndex> index_of(memory);
  for (std::size_t i = 0; i < host.size(); ++i)
    if (!host[i].empty())
      index_of.push_back({key_of(host[i], is_loose, memory), static_cast<std::int32_t>(i)});
  // Where keys are equal, the host's first one counts.
  std::sort(index_of.begin(), index_of.end(), [](const KeyedIndex& a, const KeyedIndex& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  });
  std::size_t unmatched = 0;
  for (std::size_t b = 0; b < own.size(); ++b) {
    const String key = key_of(own[b], is_loose, memory);
    const auto found =
        std::lower_bound(index_of.begin(), index_of.end(), key,
                         [](const KeyedIndex& entry, const String& wanted) { return entry.key < wanted; });
    std::int32_t index = found == index_of.end() || found->key != key ? -1 : found->index;
    if (index < 0 && !model.bind.empty() && model.bind.bones[b].first_of_joint < b)
      index = transform_of_bone[model.bind.bones[b].first_of_joint];
    transform_of_bone[b] = index;
    unmatched += index < 0;
  }
  return unmatched;
}

}  // namespace nook
