// Sound inputs of one fuzz target, made by the program itself: the corpus begins with them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nook::test {

struct Seed {
  std::string name;  // of its file in the corpus
  std::vector<std::byte> bytes;
};

// One definition for each target.
std::vector<Seed> seeds();

}  // namespace nook::test
