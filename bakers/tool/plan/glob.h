// Names of files with wildcards, as a manifest has them: * stands for any text in one name, ? for any
// character in it, and ** for any folders. A backslash makes the next character stand for itself.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nook::tool::plan {

// Both are relative, with slashes, and without "." and "..". A name that begins with a dot matches only a
// pattern that writes the dot.
bool matches(const std::string& pattern, const std::string& path);

// Returns the pattern of a text that stands for itself.
std::string literal_pattern(const std::string& text);

// The files below a root. Each folder is read once, when a pattern first leads there.
class FileTree {
 public:
  // `skipped` is a folder that is never read, or empty.
  FileTree(std::filesystem::path root, std::filesystem::path skipped);

  // Returns the files that match, relative to the root and sorted. Links to folders are followed where the
  // pattern names them, and not below **.
  std::vector<std::string> find(const std::string& pattern);

  // Returns every folder that was read, relative to the root; "" is the root. Other files in them could
  // change what find() returns.
  std::vector<std::string> folders() const;

 private:
  struct Entry {
    std::string name;
    bool is_folder, is_file, is_link;
  };
  using Names = std::vector<std::string>;

  const std::vector<Entry>& entries(const std::string& folder);
  void search(const Names& pattern, std::size_t at, const std::string& folder, Names& found);
  void enter(const Names& pattern, std::size_t at, const std::string& folder, const Entry& entry,
             Names& found);

  std::filesystem::path root_, skipped_;
  std::map<std::string, std::vector<Entry>> read_;
};

}  // namespace nook::tool::plan
