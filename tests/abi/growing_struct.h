// Checks of every public struct that grows, for all libraries that fill or read it: with callers compiled
// with the first release's header, with this one, and with a newer one.
#pragma once

#include <nook/nook.h>

#include <cstddef>
#include <cstring>

#include "tests/catch.h"

namespace nook::test {

// A struct with room behind it for the fields of a newer header, every byte marked.
template <class Struct>
struct Roomy {
  static constexpr unsigned char mark = 0xa5;
  static constexpr std::size_t newer_size = sizeof(Struct) + 16;

  Roomy() { std::memset(bytes, mark, sizeof bytes); }
  Struct* get() { return reinterpret_cast<Struct*>(bytes); }
  bool marked_from(std::size_t first) const {
    for (std::size_t i = first; i < sizeof bytes; ++i)
      if (bytes[i] != mark) return false;
    return true;
  }

  alignas(Struct) unsigned char bytes[sizeof(Struct) + 32];
};

// 1.0 is the first release of all structs; one that gains a field passes its size of then as first_size.
template <class Desc>
void check_init(nook_result (*init_type)(std::uint32_t, void*, std::size_t, std::uint32_t),
                std::uint32_t type, std::size_t first_size = sizeof(Desc)) {
  const auto init = [&](Desc* desc, std::size_t size, std::uint32_t version) {
    return init_type(type, desc, size, version);
  };
  Roomy<Desc> known;
  REQUIRE(init(known.get(), sizeof(Desc), NOOK_VERSION) == NOOK_OK);
  CHECK(known.get()->struct_size == sizeof(Desc));
  CHECK(known.get()->type == type);
  CHECK(known.marked_from(sizeof(Desc)));

  Roomy<Desc> older;
  REQUIRE(init(older.get(), first_size, NOOK_VERSION) == NOOK_OK);
  CHECK(older.get()->struct_size == first_size);
  CHECK(older.marked_from(first_size));
  CHECK(std::memcmp(older.bytes + sizeof(std::uint32_t), known.bytes + sizeof(std::uint32_t),
                    first_size - sizeof(std::uint32_t)) == 0);

  Roomy<Desc> newer;
  REQUIRE(init(newer.get(), Roomy<Desc>::newer_size, NOOK_VERSION) == NOOK_OK);
  CHECK(newer.get()->struct_size == Roomy<Desc>::newer_size);
  for (std::size_t i = sizeof(Desc); i < Roomy<Desc>::newer_size; ++i) CHECK(newer.bytes[i] == 0);
  CHECK(newer.marked_from(Roomy<Desc>::newer_size));

  Roomy<Desc> too_small;
  CHECK(init(too_small.get(), first_size - 1, NOOK_VERSION) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(init(too_small.get(), sizeof(Desc), NOOK_VERSION + (1u << 22)) == NOOK_ERROR_VERSION);
  CHECK(too_small.marked_from(0));
  CHECK(init(nullptr, sizeof(Desc), NOOK_VERSION) == NOOK_ERROR_INVALID_ARGUMENT);
}

// use(desc) hands a descriptor over, whose fields beyond the three of the header come from *good. Its
// result must be the same for every size that fits, and INVALID_ARGUMENT for what this library cannot know.
template <class Desc, class Use>
void check_use(const Desc& good, Use&& use, std::size_t first_size = sizeof(Desc)) {
  Roomy<Desc> roomy;
  Desc* const desc = roomy.get();
  const auto sized = [&](std::size_t size) {
    *desc = good;
    desc->struct_size = static_cast<std::uint32_t>(size);
    return desc;
  };
  const nook_result expected = use(sized(sizeof(Desc)));
  CHECK(use(sized(first_size)) == expected);
  std::memset(roomy.bytes + sizeof(Desc), 0, sizeof roomy.bytes - sizeof(Desc));
  CHECK(use(sized(Roomy<Desc>::newer_size)) == expected);

  roomy.bytes[Roomy<Desc>::newer_size - 1] = 1;
  CHECK(use(sized(Roomy<Desc>::newer_size)) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(use(sized(first_size - 1)) == NOOK_ERROR_INVALID_ARGUMENT);
  sized(sizeof(Desc))->next = &roomy;
  CHECK(use(desc) == NOOK_ERROR_INVALID_ARGUMENT);
  ++sized(sizeof(Desc))->type;
  CHECK(use(desc) == NOOK_ERROR_INVALID_ARGUMENT);
}

// get(info) fills a struct whose struct_size the caller set.
template <class Info, class Get>
void check_info(Get&& get, std::size_t first_size = sizeof(Info)) {
  for (const std::size_t size : {first_size, sizeof(Info), Roomy<Info>::newer_size}) {
    Roomy<Info> roomy;
    roomy.get()->struct_size = static_cast<std::uint32_t>(size);
    REQUIRE(get(roomy.get()) == NOOK_OK);
    CHECK(roomy.get()->struct_size == size);
    CHECK(roomy.marked_from(size < sizeof(Info) ? size : sizeof(Info)));
    CHECK_FALSE(roomy.marked_from(sizeof(std::uint32_t)));
  }
  Roomy<Info> too_small;
  too_small.get()->struct_size = static_cast<std::uint32_t>(first_size - 1);
  CHECK(get(too_small.get()) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(too_small.marked_from(sizeof(std::uint32_t)));
  CHECK(get(nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
}

}  // namespace nook::test
