#include "bakers/character/clip_families.h"

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

}  // namespace

std::string clip_family(std::string_view name) {
  name.remove_prefix(name.find_last_of("|:") + 1);  // npos + 1 is 0
  std::size_t i = 0;
  while (i < name.size() && !is_letter(name[i])) ++i;
  std::string word;
  for (; i < name.size() && is_letter(name[i]); ++i) {
    if (!word.empty() && begins_word(name, i)) break;
    word += is_upper(name[i]) ? char(name[i] - 'A' + 'a') : name[i];
  }
  return word;
}

}  // namespace nook::bake
