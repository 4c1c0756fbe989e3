#include "bakers/lab/gpu_cost/instruction_count.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <stdexcept>

namespace nook::lab {
namespace {

bool begins_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view beginning) { return text.starts_with(beginning); });
}

struct Instruction {
  std::string mnemonic;
  std::string target;  // the target block of a branch
};

struct Block {
  std::string name;
  std::vector<Instruction> instructions;
};

bool is_branch(std::string_view mnemonic) {
  return begins_with_any(mnemonic, {"s_cbranch", "s_branch"});
}

// Returns whether a line is a label. A label such as `BB12:` begins at the start of the line; instructions
// are indented.
bool is_label(std::string_view line) {
  return line.starts_with("BB") && line.find(':') != line.npos;
}

Instruction parse_instruction(std::string_view line) {
  Instruction instruction;
  std::istringstream words{std::string(line)};
  words >> instruction.mnemonic;
  if (is_branch(instruction.mnemonic)) words >> instruction.target;
  return instruction;
}

std::vector<Block> parse_blocks(const std::string& disassembly) {
  std::vector<Block> blocks{{"entry", {}}};
  std::istringstream lines(disassembly);
  for (std::string line; std::getline(lines, line);) {
    if (is_label(line)) {
      blocks.push_back({line.substr(0, line.find(':')), {}});
    } else if (line.size() > 1 && std::isspace(static_cast<unsigned char>(line[0]))) {
      const Instruction instruction = parse_instruction(line);
      if (!instruction.mnemonic.empty() && std::islower(static_cast<unsigned char>(instruction.mnemonic[0])))
        blocks.back().instructions.push_back(instruction);
    }
  }
  return blocks;
}

// A range of blocks. For a loop, the last block jumps back to the first.
struct Span {
  std::size_t first = 0, last = 0;
};

std::map<std::string, std::size_t> places_of(const std::vector<Block>& blocks) {
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < blocks.size(); ++i) place[blocks[i].name] = i;
  return place;
}

std::vector<Span> find_loops(const std::vector<Block>& blocks) {
  const std::map<std::string, std::size_t> place = places_of(blocks);
  std::map<std::size_t, std::size_t> last_of;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (const Instruction& instruction : blocks[i].instructions) {
      if (instruction.target.empty()) continue;
      const auto target = place.find(instruction.target);
      if (target == place.end())
        throw std::runtime_error("nook_gpu_cost: a branch goes to " + instruction.target +
                                 ", which is not a block");
      if (target->second <= i) last_of[target->second] = std::max(last_of[target->second], i);
    }
  std::vector<Span> spans;
  for (const auto& [first, last] : last_of) spans.push_back({first, last});
  return spans;
}

int arithmetic_cycles(const std::vector<Block>& blocks, Span span) {
  int cycles = 0;
  for (std::size_t b = span.first; b <= span.last; ++b)
    for (const Instruction& instruction : blocks[b].instructions) {
      const InstructionClass kind = classify(instruction.mnemonic);
      cycles += kind == InstructionClass::vector ? 1 : kind == InstructionClass::quarter_rate ? 4 : 0;
    }
  return cycles;
}

// Finds large regions that do not contain a loop and that a wave skips if none of its threads enters them.
std::vector<Span> find_branches(const std::vector<Block>& blocks, const std::vector<Span>& loops) {
  const std::map<std::string, std::size_t> place = places_of(blocks);
  std::vector<Span> spans;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (const Instruction& instruction : blocks[i].instructions) {
      if (instruction.mnemonic != "s_cbranch_execz") continue;
      const std::size_t target = place.at(instruction.target);
      if (target <= i + 1) continue;
      const Span span{i + 1, target - 1};
      const bool has_loop = std::any_of(loops.begin(), loops.end(), [&](const Span& loop) {
        return span.first <= loop.first && loop.last <= span.last;
      });
      if (!has_loop && arithmetic_cycles(blocks, span) >= least_branch_cycles) spans.push_back(span);
    }
  return spans;
}

bool has_branch(const std::vector<Loop>& loops) {
  return std::any_of(loops.begin(), loops.end(),
                     [](const Loop& loop) { return loop.is_branch || has_branch(loop.inside); });
}

// Returns the loops, and also the large branches if `branches` is true. They are in the order of the text,
// outer ones before inner ones.
std::vector<Span> find_spans(const std::vector<Block>& blocks, bool branches) {
  std::vector<Span> spans = find_loops(blocks);
  if (!branches) return spans;
  const std::vector<Span> found = find_branches(blocks, spans);
  spans.insert(spans.end(), found.begin(), found.end());
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
    return a.first != b.first ? a.first < b.first : a.last > b.last;
  });
  return spans;
}

// An expected loop with its nesting depth. In the list, outer loops come before their inner loops.
struct FlatLoop {
  const Loop* loop;
  std::size_t depth;
};

void flatten(const std::vector<Loop>& loops, std::size_t depth, std::vector<FlatLoop>& out) {
  for (const Loop& loop : loops) {
    out.push_back({&loop, depth});
    flatten(loop.inside, depth + 1, out);
  }
}

std::size_t depth_of(const std::vector<Span>& spans, std::size_t i) {
  return std::size_t(std::count_if(spans.begin(), spans.end(), [&](const Span& outer) {
    return &outer != &spans[i] && outer.first <= spans[i].first && spans[i].last <= outer.last;
  }));
}

std::string describe(const std::vector<Block>& blocks, const std::vector<Span>& spans) {
  std::ostringstream out;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    InstructionCounts counts;
    for (std::size_t b = spans[i].first; b <= spans[i].last; ++b)
      for (const Instruction& instruction : blocks[b].instructions) ++counts[classify(instruction.mnemonic)];
    out << std::string(2 * depth_of(spans, i) + 2, ' ') << blocks[spans[i].first].name << " to "
        << blocks[spans[i].last].name << ": " << counts[InstructionClass::vector] << " vector, "
        << counts[InstructionClass::quarter_rate] << " quarter rate, " << counts[InstructionClass::fetch]
        << " fetches, " << counts[InstructionClass::local_memory] << " of local memory\n";
  }
  return spans.empty() ? "  none\n" : out.str();
}

std::string describe(const std::vector<FlatLoop>& loops) {
  std::ostringstream out;
  for (const FlatLoop& at : loops)
    out << std::string(2 * at.depth + 2, ' ') << at.loop->over << ": " << at.loop->trips << " trips\n";
  return loops.empty() ? "  none\n" : out.str();
}

}  // namespace

InstructionClass classify(std::string_view m) {
  using enum InstructionClass;
  if (begins_with_any(m,
                      {"v_rcp_", "v_rsq_", "v_sqrt_", "v_sin_", "v_cos_", "v_exp_", "v_log_", "v_mul_lo_u32",
                       "v_mul_lo_i32", "v_mul_hi_u32", "v_mul_hi_i32", "v_mad_u64_u32", "v_mad_i64_i32"})) {
    // Multiplications of 24-bit integers, such as v_mul_hi_u32_u24, run at the full rate.
    return m.find("24") == m.npos ? quarter_rate : vector;
  }
  if (begins_with_any(m, {"v_"})) return vector;
  if (begins_with_any(m, {"image_", "buffer_", "tbuffer_", "global_", "flat_", "scratch_"})) {
    if (m.find("store") != m.npos) return store;
    return m.find("_gl0_inv") != m.npos || m.find("_gl1_inv") != m.npos ? other : fetch;
  }
  if (begins_with_any(m, {"ds_"})) return local_memory;
  if (begins_with_any(m, {"s_load", "s_buffer_load"})) return scalar_load;
  if (is_branch(m) || begins_with_any(m, {"s_waitcnt", "s_nop", "s_clause", "s_delay_alu", "s_inst_prefetch",
                                          "s_code_end", "s_endpgm", "s_sendmsg", "s_barrier"}))
    return other;
  return begins_with_any(m, {"s_"}) ? scalar : other;
}

InstructionCounts count_instructions(const std::string& disassembly, const std::vector<Loop>& expected) {
  const std::vector<Block> blocks = parse_blocks(disassembly);
  const std::vector<Span> spans = find_spans(blocks, has_branch(expected));
  std::vector<FlatLoop> loops;
  flatten(expected, 0, loops);
  bool same = spans.size() == loops.size();
  for (std::size_t i = 0; same && i < spans.size(); ++i) same = depth_of(spans, i) == loops[i].depth;
  if (!same)
    throw std::runtime_error("the compiled loops differ from the loops that have trip counts\n compiled:\n" +
                             describe(blocks, spans) + " expected:\n" + describe(loops));
  InstructionCounts counts;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    double weight = 1;
    for (std::size_t i = 0; i < spans.size(); ++i)
      if (spans[i].first <= b && b <= spans[i].last) weight *= loops[i].loop->trips;
    for (const Instruction& instruction : blocks[b].instructions)
      counts[classify(instruction.mnemonic)] += weight;
  }
  return counts;
}

std::string describe_loops(const std::string& disassembly) {
  const std::vector<Block> blocks = parse_blocks(disassembly);
  return describe(blocks, find_loops(blocks));
}

}  // namespace nook::lab
