// Counts the instructions of a disassembly that a wave executes: loops are weighed by their trip counts, and
// both sides of every branch count, or large branches by the share of threads that take them.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace nook::lab {

enum class InstructionClass {
  vector,        // full rate
  quarter_rate,  // transcendental functions and multiplication of 32-bit integers
  fetch,         // of textures and buffers
  store,
  local_memory,  // memory that a group shares
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

// A loop of the source that must be one of the disassembly too, with those inside it, in the order of the
// text. Where one of the expected ones is a branch, all branches of least_branch_cycles or more that threads
// may skip and that hold no loop must be there as well.
struct Loop {
  const char* over;  // what it runs over, or what takes the branch
  double trips = 0;  // of a branch the share of threads that take it
  std::vector<Loop> inside;
  bool is_branch = false;
};
inline constexpr int least_branch_cycles = 90;  // of arithmetic

// Throws where the disassembly's loops have another nesting than the expected ones: a compiler that unrolls
// otherwise. The message shows both.
InstructionCounts count_instructions(const std::string& disassembly, const std::vector<Loop>& expected);

// The loops of a disassembly as text, each with its first block and the instructions of one trip.
std::string describe_loops(const std::string& disassembly);

}  // namespace nook::lab
