// Mutates inputs of container_input.h by their parts: one section of the file, or the script. The table of
// the file follows, so that a longer or shorter section does not end in the checks of the container. One
// mutation in eight is blind.
#include <cstring>
#include <random>
#include <span>

#include "tests/fuzz/container_input.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace nook;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t head_size = 40, entry_size = 24;

std::uint64_t read_little(std::span<const std::uint8_t> bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value |= std::uint64_t(bytes[at + std::size_t(i)]) << (8 * i);
  return value;
}

void write_little(Bytes& bytes, std::size_t at, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) bytes[at + std::size_t(i)] = std::uint8_t(value >> (8 * i));
}

struct Parts {
  Bytes head;                   // with the section table
  std::vector<Bytes> sections;  // in the order of the table
  Bytes script;
};

// False where the table does not fit the file, or its sections add up to more than the file.
bool read_parts(std::span<const std::uint8_t> input, Parts& parts) {
  const auto file = input.first(test::file_size_of(input));
  if (file.size() < head_size) return false;
  const std::uint64_t count = read_little(file, 32, 4);
  if (count == 0 || count > (file.size() - head_size) / entry_size) return false;
  parts.head.assign(file.begin(), file.begin() + std::ptrdiff_t(head_size + count * entry_size));
  std::size_t sum = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t at = head_size + i * entry_size;
    const std::uint64_t offset = read_little(file, at + 8, 8), size = read_little(file, at + 16, 8);
    if (offset > file.size() || size > file.size() - offset || (sum += size) > file.size()) return false;
    const auto section = file.subspan(offset, size);
    parts.sections.emplace_back(section.begin(), section.end());
  }
  const auto script = input.subspan(file.size());
  parts.script.assign(script.begin(), script.end());
  return true;
}

void mutate(Bytes& bytes, std::size_t room) {
  const std::size_t size = bytes.size();
  bytes.resize(size + room);
  if (!bytes.empty()) bytes.resize(LLVMFuzzerMutate(bytes.data(), size, bytes.size()));
}

Bytes write_parts(Parts& parts) {
  std::size_t offset = parts.head.size();
  for (std::size_t i = 0; i < parts.sections.size(); ++i) {
    write_little(parts.head, head_size + i * entry_size + 8, offset);
    write_little(parts.head, head_size + i * entry_size + 16, parts.sections[i].size());
    offset += parts.sections[i].size();
  }
  write_little(parts.head, 16, offset);
  Bytes whole = parts.head;
  for (const Bytes& section : parts.sections) whole.insert(whole.end(), section.begin(), section.end());
  repair_checksum(std::as_writable_bytes(std::span(whole)));
  whole.insert(whole.end(), parts.script.begin(), parts.script.end());
  return whole;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  random.discard(2);
  Parts parts;
  const std::uint32_t choice = random() % 8;
  if (choice == 0 || !read_parts({data, size}, parts)) return LLVMFuzzerMutate(data, size, max_size);
  const std::size_t room = size < max_size ? std::min<std::size_t>(max_size - size, 256) : 0;
  if (choice <= 4)
    mutate(parts.script, room);
  else
    mutate(parts.sections[random() % parts.sections.size()], room);
  const Bytes whole = write_parts(parts);
  if (whole.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, whole.data(), whole.size());
  return whole.size();
}
