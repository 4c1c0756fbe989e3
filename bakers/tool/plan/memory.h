// What nook plan remembers in DIR/plan.json, so that a plan in which nothing changed reads no asset:
// identities of bakes and of their outputs, with size and times of the files that they were read from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bakers/tool/plan/bake_words.h"

namespace nook::tool::plan {

// A file that did not change has an equal stamp. The time of its last change of status is in it, because a
// copy can keep the time of its source.
struct Stamp {
  std::int64_t bytes = -1, modified_ns = 0, changed_ns = 0;  // -1: there is no file

  bool operator==(const Stamp&) const = default;
};
Stamp stamp_of(const std::filesystem::path& path);

struct StampedFile {
  std::string path;
  Stamp stamp;
};

// The identity of a bake, as it was when these words read these files.
struct KnownBake {
  Words words;
  std::vector<StampedFile> read;
  std::string identity;
};

// The identity in the recipe of an output, empty if it has none.
struct KnownOutput {
  Stamp stamp;
  std::string identity;
};

struct Memory {
  std::map<std::string, KnownBake> bakes;      // by output
  std::map<std::string, KnownOutput> outputs;  // by output
};

// Returns nothing for a file that is missing, damaged, or of another tool.
Memory read_memory(const std::filesystem::path& file, const std::string& tool);
std::string memory_text(const Memory& memory, const std::string& tool);

// Names this program and the instruction set that it is pinned to.
std::string this_tool();

// True if every file has its stamp still.
bool is_unchanged(const std::vector<StampedFile>& files);

// True if a file changed shortly before `began_ns` or later. A further change could then leave its stamp
// equal, because file systems count time in steps of up to 10 ms.
bool is_too_young(const std::vector<StampedFile>& files, std::int64_t began_ns);
std::int64_t now_ns();

// Reads the identity in an output's recipe. Empty if the file is not a .nook file or has none.
std::string identity_in(const std::filesystem::path& output);

}  // namespace nook::tool::plan
