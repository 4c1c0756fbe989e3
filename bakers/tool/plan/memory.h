// What `nook plan` remembers in DIR/plan.json: the identities of bakes and of their outputs, with the sizes
// and times of the files that they were read from. If nothing has changed, the next plan need not read any
// asset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bakers/tool/plan/bake_words.h"

namespace nook::tool::plan {

// As long as a file does not change, its stamp stays the same. The stamp includes the time of the last status
// change (ctime), because a copied file can have the modification time of its source.
struct Stamp {
  std::int64_t bytes = -1, modified_ns = 0, changed_ns = 0;  // -1: there is no file

  bool operator==(const Stamp&) const = default;
};
Stamp stamp_of(const std::filesystem::path& path);

struct StampedFile {
  std::string path;
  Stamp stamp;
};

// The identity of a bake, computed when a bake with these words read these files.
struct KnownBake {
  Words words;
  std::vector<StampedFile> read;
  std::string identity;
};

// The identity in the recipe of an output; empty if the recipe has none.
struct KnownOutput {
  Stamp stamp;
  std::string identity;
};

struct Memory {
  std::map<std::string, KnownBake> bakes;      // the key is the output
  std::map<std::string, KnownOutput> outputs;  // the key is the output
};

// Returns an empty memory if the file is missing or damaged, or if another tool wrote it.
Memory read_memory(const std::filesystem::path& file, const std::string& tool);
std::string memory_text(const Memory& memory, const std::string& tool);

// Returns the name of this program and of the instruction set that it is pinned to.
std::string this_tool();

// Returns true if every file still has its stamp.
bool is_unchanged(const std::vector<StampedFile>& files);

// Returns true if a file changed shortly before `began_ns` or later. File systems store times in steps of up
// to 10 ms, so a second change within this time might not change the stamp.
bool is_too_young(const std::vector<StampedFile>& files, std::int64_t began_ns);
std::int64_t now_ns();

// Reads the identity in an output's recipe. Returns an empty text if the file is not a .nook file or has no
// identity.
std::string identity_in(const std::filesystem::path& output);

}  // namespace nook::tool::plan
