#include "sdk/src/core/container.h"

#include <algorithm>
#include <array>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"

namespace nook {
namespace {

constexpr FourLetters magic = four_letters("NOOK");
constexpr std::uint32_t order_mark = 0x01020304, swapped_mark = 0x04030201;
constexpr std::size_t checksum_at = 24, head_size = container_head_bytes, entry_size = 24;

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  Hash64 hash;
  hash.add(bytes.first(checksum_at));
  hash.add(bytes.subspan(checksum_at + 8));
  return hash.value();
}

// Returns the four letters as a C string. Unprintable letters become '?', so that a malicious file cannot
// write control sequences to the host's terminal.
std::array<char, 5> letters(FourLetters value) {
  std::array<char, 5> text{};
  for (int i = 0; i < 4; ++i) {
    const char c = static_cast<char>((value >> (8 * i)) & 255);
    text[i] = c >= ' ' && c <= '~' ? c : '?';
  }
  return text;
}

}  // namespace

std::vector<std::byte> write_container(const ContainerKind& kind,
                                       std::span<const ContainerSection> sections) {
  ByteWriter head, body;
  std::uint64_t offset = head_size + entry_size * sections.size();
  ByteWriter table;
  for (const ContainerSection& section : sections) {
    table.u32(section.name);
    table.u32(0);
    table.u64(offset);
    table.u64(section.bytes.size());
    offset += section.bytes.size();
  }
  head.u32(magic);
  head.u32(order_mark);
  head.u32(kind.newest_version);
  head.u32(kind.kind);
  head.u64(offset);
  head.u64(0);
  head.u32(static_cast<std::uint32_t>(sections.size()));
  head.u32(0);

  std::vector<std::byte> file = head.bytes();
  file.insert(file.end(), table.bytes().begin(), table.bytes().end());
  for (const ContainerSection& section : sections)
    file.insert(file.end(), section.bytes.begin(), section.bytes.end());
  repair_checksum(file);
  return file;
}

void repair_checksum(std::span<std::byte> bytes) {
  if (bytes.size() < head_size) return;
  ByteWriter sum;
  sum.u64(checksum_of(bytes));
  std::copy(sum.bytes().begin(), sum.bytes().end(), bytes.begin() + checksum_at);
}

FourLetters container_kind(std::span<const std::byte> bytes) {
  if (bytes.size() < head_size) return 0;
  ByteReader head(bytes, "head");
  if (head.u32() != magic || head.u32() != order_mark) return 0;
  head.u32();
  return head.u32();
}

std::uint64_t container_size(std::span<const std::byte> bytes) {
  if (container_kind(bytes) == 0) return 0;
  ByteReader head(bytes.subspan(16), "head");
  return head.u64();
}

Container::Container(std::span<const std::byte> bytes, const ContainerKind& kind) : bytes_(bytes) {
  if (bytes.size() < head_size)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the file is too short (got %zu bytes, need at least %zu); it is not a .nook file",
                  bytes.size(), head_size);
  ByteReader head(bytes, "head");
  if (head.u32() != magic)
    throw Failure(NOOK_ERROR_BAD_FILE, "the first bytes are not \"NOOK\"; this is not a .nook file");
  const std::uint32_t mark = head.u32();
  if (mark == swapped_mark)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the file is big-endian, need little-endian; bake it with this version");
  if (mark != order_mark)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the byte-order mark is wrong (got 0x%08x, need 0x%08x); the file is damaged", mark,
                  order_mark);
  version_ = head.u32();
  const FourLetters found_kind = head.u32();
  if (found_kind != kind.kind)
    throw Failure(NOOK_ERROR_BAD_FILE, "the file holds another kind of data (got \"%s\", need \"%s\", a %s)",
                  letters(found_kind).data(), letters(kind.kind).data(), kind.name);
  if (version_ > kind.newest_version)
    throw Failure(NOOK_ERROR_FILE_VERSION,
                  "the file's format version is too new (got %u, need %u or older); use a newer library or "
                  "bake it again",
                  version_, kind.newest_version);
  if (version_ < kind.oldest_version)
    throw Failure(NOOK_ERROR_FILE_VERSION,
                  "the file's format version is too old (got %u, need %u or newer); bake it again", version_,
                  kind.oldest_version);
  const std::uint64_t size = head.u64();
  if (size != bytes.size())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the file's size is wrong (got %zu bytes, need %llu); it was cut or extended", bytes.size(),
                  static_cast<unsigned long long>(size));
  if (head.u64() != checksum_of(bytes))
    throw Failure(NOOK_ERROR_BAD_FILE, "the checksum is wrong; the file is damaged, copy or bake it again");
  sections_ = head.u32();
  if (sections_ > (bytes.size() - head_size) / entry_size)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the section table does not fit the file (got %u sections in %zu bytes)", sections_,
                  bytes.size());
  for (std::uint32_t i = 0; i < sections_; ++i) {
    const Entry e = entry(i);
    if (e.offset > bytes.size() || e.size > bytes.size() - e.offset)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "section %s lies outside the file (offset %llu, size %llu, file %zu bytes)",
                    letters(e.name).data(), static_cast<unsigned long long>(e.offset),
                    static_cast<unsigned long long>(e.size), bytes.size());
  }
}

Container::Entry Container::entry(std::uint32_t index) const {
  ByteReader reader(bytes_.subspan(head_size + entry_size * index, entry_size), "table");
  Entry e{};
  e.name = reader.u32();
  reader.u32();
  e.offset = reader.u64();
  e.size = reader.u64();
  return e;
}

bool Container::find(FourLetters name, Entry& found) const {
  for (std::uint32_t i = 0; i < sections_; ++i) {
    found = entry(i);
    if (found.name == name) return true;
  }
  return false;
}

bool Container::has(const char (&name)[5]) const {
  Entry e{};
  return find(four_letters(name), e);
}

ByteReader Container::section(const char (&name)[5]) const {
  Entry e{};
  if (!find(four_letters(name), e))
    throw Failure(NOOK_ERROR_BAD_FILE, "section %s is missing; bake the file again", name);
  return {bytes_.subspan(e.offset, e.size), name};
}

}  // namespace nook
