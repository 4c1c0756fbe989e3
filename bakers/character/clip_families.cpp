#include "bakers/character/clip_families.h"

#include <algorithm>

namespace nook::bake {
namespace {

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}

// Bytes of UTF-8 beyond ASCII are letters.
bool is_letter(char c) {
  return is_lower(c) || is_upper(c) || static_cast<unsigned char>(c) >= 0x80;
}

// At a capital: behind a letter that is none (jumpStart), or as the last of several before one (UALWalk).
bool begins_word(std::string_view name, std::size_t i) {
  if (!is_upper(name[i])) return false;
  return !is_upper(name[i - 1]) || (i + 1 < name.size() && is_lower(name[i + 1]));
}

std::string_view without_namespace(std::string_view name) {
  name.remove_prefix(name.find_last_of("|:") + 1);  // npos + 1 is 0
  return name;
}

// The length of what all names begin with, up to and with its last byte that is no letter.
std::size_t shared_prefix(std::span<const std::string_view> names) {
  if (names.size() < 2) return 0;
  std::string_view shared = names.front();
  for (const std::string_view name : names) {
    const auto differ = std::mismatch(shared.begin(), shared.end(), name.begin(), name.end());
    shared = shared.substr(0, std::size_t(differ.first - shared.begin()));
  }
  while (!shared.empty() && is_letter(shared.back())) shared.remove_suffix(1);
  return shared.size();
}

std::string first_word(std::string_view name) {
  std::size_t i = 0;
  while (i < name.size() && !is_letter(name[i])) ++i;
  std::string word;
  for (; i < name.size() && is_letter(name[i]); ++i) {
    if (!word.empty() && begins_word(name, i)) break;
    word += is_upper(name[i]) ? char(name[i] - 'A' + 'a') : name[i];
  }
  return word;
}

}  // namespace

std::vector<std::string> clip_families(std::span<const std::string_view> names) {
  std::vector<std::string_view> own;
  for (const std::string_view name : names) own.push_back(without_namespace(name));
  const std::size_t prefix = shared_prefix(own);
  std::vector<std::string> families;
  for (const std::string_view name : own) families.push_back(first_word(name.substr(prefix)));
  return families;
}

}  // namespace nook::bake
