// Counts the instructions of a disassembly that a wave executes. Loops are weighed by their trip counts. Both
// sides of a branch count, or for large branches the share of threads that take them.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace nook::lab {

enum class InstructionClass {
  vector,        // full rate
  quarter_rate,  // transcendental functions and multiplication of 32-bit integers
  fetch,         // textures and buffers
  store,
  local_memory,  // memory shared by a group
  scalar,
  scalar_load,
  other,  // branches, waiting, exports
};
inline constexpr std::size_t instruction_class_count = 8;

InstructionClass classify(std::string_view mnemonic);

struct InstructionCounts {
  std::array<double, instruction_class_count> number{};

  double& operator[](InstructionClass c) { return number[std::size_t(c)]; }
  double operator[](InstructionClass c) const { return number[std::size_t(c)]; }
};

// A loop of the source that the disassembly must also have, with the loops inside it, in the order of the
// text. If one entry is a branch, the entries must include every branch that threads may skip, with
// least_branch_cycles or more and without a loop.
struct Loop {
  const char* over;  // what it loops over, or what takes the branch
  double trips = 0;  // for a branch, the share of threads that take it
  std::vector<Loop> inside;
  bool is_branch = false;
};
inline constexpr int least_branch_cycles = 90;  // for arithmetic

// Throws if the disassembly's loops are nested otherwise than expected, because a compiler unrolls
// differently. The message shows both.
InstructionCounts count_instructions(const std::string& disassembly, const std::vector<Loop>& expected);

// Returns the loops of a disassembly as text. Each has its first block and the instructions of one trip.
std::string describe_loops(const std::string& disassembly);

}  // namespace nook::lab
