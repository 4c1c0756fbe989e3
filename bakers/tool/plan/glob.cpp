#include "bakers/tool/plan/glob.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view any_folders = "**";

std::vector<std::string> names_of(const std::string& path) {
  std::vector<std::string> names;
  std::size_t begin = 0;
  for (std::size_t end; (end = path.find('/', begin)) != std::string::npos; begin = end + 1)
    names.push_back(path.substr(begin, end - begin));
  names.push_back(path.substr(begin));
  return names;
}

// After a backslash, the next character is not a wildcard. literal_pattern() writes such backslashes.
bool name_matches(std::string_view pattern, std::string_view name) {
  if (name.starts_with('.') && !pattern.starts_with('.')) return false;
  // The position of the last *, and the end of the text that it matches. On a mismatch, * is extended by one
  // character.
  std::size_t p = 0, n = 0, star = std::string_view::npos, swallowed = 0;
  while (n < name.size()) {
    const bool escaped = p + 1 < pattern.size() && pattern[p] == '\\';
    if (!escaped && p < pattern.size() && pattern[p] == '*') {
      star = p++;
      swallowed = n;
    } else if (p < pattern.size() &&
               (escaped ? pattern[p + 1] == name[n] : pattern[p] == '?' || pattern[p] == name[n])) {
      p += escaped ? 2 : 1;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++swallowed;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

using Names = std::vector<std::string>;

// Returns true if the names from index n on match the pattern from index p on.
bool names_match(const Names& pattern, std::size_t p, const Names& path, std::size_t n) {
  if (p == pattern.size()) return n == path.size();
  if (pattern[p] == any_folders) {
    for (std::size_t next = n; next <= path.size(); ++next) {
      if (names_match(pattern, p + 1, path, next)) return true;
      if (next < path.size() && path[next].starts_with('.')) return false;
    }
    return false;
  }
  return n < path.size() && name_matches(pattern[p], path[n]) && names_match(pattern, p + 1, path, n + 1);
}

std::string below(const std::string& folder, const std::string& name) {
  return folder.empty() ? name : folder + "/" + name;
}

void sort_without_equals(Names& names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace

bool matches(const std::string& pattern, const std::string& path) {
  return names_match(names_of(pattern), 0, names_of(path), 0);
}

std::string literal_pattern(const std::string& text) {
  std::string pattern;
  for (const char c : text) {
    if (c == '*' || c == '?' || c == '\\') pattern += '\\';
    pattern += c;
  }
  return pattern;
}

FileTree::FileTree(fs::path root, fs::path skipped) : root_(std::move(root)), skipped_(std::move(skipped)) {}

std::vector<std::string> FileTree::find(const std::string& pattern) {
  Names found;
  search(names_of(pattern), 0, "", found);
  sort_without_equals(found);
  return found;
}

std::vector<std::string> FileTree::folders() const {
  Names folders;
  for (const auto& [folder, entries] : read_) folders.push_back(folder);
  return folders;
}

const std::vector<FileTree::Entry>& FileTree::entries(const std::string& folder) {
  const auto known = read_.find(folder);
  if (known != read_.end()) return known->second;
  std::vector<Entry>& entries = read_[folder];
  std::error_code error;
  for (fs::directory_iterator at(root_ / folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;
    if (at->path() == skipped_) continue;
    entries.push_back({at->path().filename().string(), at->is_directory(gone), at->is_regular_file(gone),
                       at->is_symlink(gone)});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return entries;
}

void FileTree::enter(const Names& pattern, std::size_t at, const std::string& folder, const Entry& entry,
                     Names& found) {
  const bool any = pattern[at] == any_folders, last = at + 1 == pattern.size();
  if (any ? entry.name.starts_with('.') : !name_matches(pattern[at], entry.name)) return;
  const std::string path = below(folder, entry.name);
  if (entry.is_folder && any && !entry.is_link) search(pattern, at, path, found);
  if (entry.is_folder && !any && !last) search(pattern, at + 1, path, found);
  if (entry.is_file && last) found.push_back(path);
}

void FileTree::search(const Names& pattern, std::size_t at, const std::string& folder, Names& found) {
  // ** also matches zero folders.
  if (pattern[at] == any_folders && at + 1 < pattern.size()) search(pattern, at + 1, folder, found);
  const std::string begin =
      pattern[at] == any_folders ? "" : pattern[at].substr(0, pattern[at].find_first_of("*?\\"));
  const bool is_literal = begin == pattern[at] && pattern[at] != any_folders;
  std::error_code error;
  if (is_literal && at + 1 < pattern.size()) {
    // A folder that the pattern names is entered without reading its parent.
    const std::string path = below(folder, begin);
    if (fs::is_directory(root_ / path, error)) search(pattern, at + 1, path, found);
    return;
  }
  const std::vector<Entry>& all = entries(folder);
  auto entry = std::lower_bound(all.begin(), all.end(), begin,
                                [](const Entry& e, const std::string& name) { return e.name < name; });
  for (; entry != all.end() && entry->name.starts_with(begin); ++entry)
    enter(pattern, at, folder, *entry, found);
}

}  // namespace nook::tool::plan
