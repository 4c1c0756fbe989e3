// Counts the instructions that a wave executes, from a disassembly. The instructions of a loop are multiplied
// by its trip count. Both sides of a branch are counted. The instructions of large branches can be multiplied
// by the share of threads that take the branch.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace nook::lab {

enum class InstructionClass {
  vector,        // vector arithmetic at the full rate
  quarter_rate,  // transcendental functions and multiplication of 32-bit integers
  fetch,         // textures and buffers
  store,
  local_memory,  // memory that the threads of a group share
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

// A loop of the source that must also exist in the disassembly. `inside` lists its inner loops in the order
// of the text. An entry can also be a branch. If you list one branch, you must also list all other branches
// that threads may skip, that contain no loop, and that have at least least_branch_cycles cycles.
struct Loop {
  const char* over;  // what the loop iterates over, or which threads take the branch
  double trips = 0;  // trip count; for a branch, the share of threads that take it
  std::vector<Loop> inside;
  bool is_branch = false;
};
inline constexpr int least_branch_cycles = 90;  // cycles of arithmetic

// Throws if the nesting of the loops in the disassembly differs from `expected`, for example because the
// compiler unrolls a loop. The message shows both.
InstructionCounts count_instructions(const std::string& disassembly, const std::vector<Loop>& expected);

// Returns the loops of a disassembly as text. Each loop is shown with the name of its first block and the
// instruction counts of one iteration.
std::string describe_loops(const std::string& disassembly);

}  // namespace nook::lab
