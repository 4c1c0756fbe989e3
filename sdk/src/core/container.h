// The .nook container, little-endian:
//   0  "NOOK"            4  u32 0x01020304, the byte-order mark
//   8  u32 format version of the kind           12  four letters, the kind
//  16  u64 size of the whole file               24  u64 XXH64 of the whole file except these 8 bytes
//  32  u32 number of sections                   36  u32 0
//  40  the section table: four letters, u32 0, u64 offset from the file's start, u64 size; then the sections.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/bytes.h"

namespace nook {

using FourLetters = std::uint32_t;
constexpr FourLetters four_letters(const char (&text)[5]) {
  FourLetters value = 0;
  for (int i = 0; i < 4; ++i) value |= FourLetters(static_cast<unsigned char>(text[i])) << (8 * i);
  return value;
}

struct ContainerKind {
  FourLetters kind = 0;
  const char* name = "";  // such as "character model"
  std::uint32_t oldest_version = 1;
  std::uint32_t newest_version = 1;
};

struct ContainerSection {
  FourLetters name = 0;
  std::vector<std::byte> bytes;
};

std::vector<std::byte> write_container(const ContainerKind& kind, std::span<const ContainerSection> sections);

// A view of the bytes of a file. It does not allocate.
class Container {
 public:
  // Checks everything except the contents of the sections. If something is wrong, throws Failure. Each kind
  // of fault has its own message.
  Container(std::span<const std::byte> bytes, const ContainerKind& kind);

  std::uint32_t version() const { return version_; }
  bool has(const char (&name)[5]) const;
  ByteReader section(const char (&name)[5]) const;  // throws Failure if it is missing

 private:
  struct Entry {
    FourLetters name;
    std::uint64_t offset;
    std::uint64_t size;
  };
  Entry entry(std::uint32_t index) const;
  bool find(FourLetters name, Entry& found) const;

  std::span<const std::byte> bytes_;
  std::uint32_t version_ = 0;
  std::uint32_t sections_ = 0;
};

// Writes the correct checksum into modified bytes. Tests use it to reach the code that runs after the
// checksum test.
void repair_checksum(std::span<std::byte> bytes);
// The number of bytes of the head. The head is the start of a file, and contains the kind and the size of the
// file.
inline constexpr std::size_t container_head_bytes = 40;
// Returns the kind of a file, so that a tool can choose a reader. Returns 0 if the bytes are not a .nook
// file. It is enough to pass the head of the file.
FourLetters container_kind(std::span<const std::byte> bytes);
// Returns the file size that is stored in the head, or 0 if the bytes are not a .nook file.
std::uint64_t container_size(std::span<const std::byte> bytes);

}  // namespace nook
