// Matches the file patterns of a manifest. * matches any text within one name, ? matches one character of a
// name, and ** matches any number of folders. After a backslash, a character is not a wildcard.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nook::tool::plan {

// Both arguments are relative paths with slashes, without "." and "..". A name that begins with a dot matches
// only if the pattern contains the dot.
bool matches(const std::string& pattern, const std::string& path);

// Returns a pattern that matches exactly this text.
std::string literal_pattern(const std::string& text);

// The files below a root. Each folder is read only once, when a pattern needs it for the first time.
class FileTree {
 public:
  // The folder `skipped` is never read. It may be empty.
  FileTree(std::filesystem::path root, std::filesystem::path skipped);

  // Returns the matching files, relative to the root and sorted. Links to folders are followed only if the
  // pattern names the folder. They are not followed below **.
  std::vector<std::string> find(const std::string& pattern);

  // Returns every folder that was read, relative to the root. "" is the root. New files in these folders
  // could change the result of find().
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
