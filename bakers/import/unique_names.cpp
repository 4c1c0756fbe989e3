#include "bakers/import/unique_names.h"

#include <unordered_map>
#include <unordered_set>

namespace nook::bake {

std::vector<std::string> unique_names(const std::vector<std::string>& names, std::string_view stem) {
  // Names as the file has them keep precedence over the ones made here.
  std::unordered_set<std::string> taken(names.begin(), names.end());
  std::unordered_set<std::string> used;
  std::unordered_map<std::string, std::size_t> next_suffix;
  std::vector<std::string> out;
  out.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string base = names[i].empty() ? std::string(stem) + "_" + std::to_string(i) : names[i];
    std::string name = base;
    const bool must_differ =
        names[i].empty() ? taken.count(name) > 0 || used.count(name) > 0 : used.count(name) > 0;
    if (must_differ) {
      std::size_t& suffix = next_suffix.try_emplace(base, 2).first->second;
      do name = base + "_" + std::to_string(suffix++);
      while (taken.count(name) > 0 || used.count(name) > 0);
    }
    used.insert(name);
    out.push_back(std::move(name));
  }
  return out;
}

}  // namespace nook::bake
