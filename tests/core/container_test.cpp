#include "sdk/src/core/container.h"

#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;

TEST_CASE("bytes and bits come back as written") {
  ByteWriter out;
  out.u8(200);
  out.u16(0xbeef);
  out.u32(0xdeadbeef);
  out.u64(0x0123456789abcdefull);
  out.f32(-1.5f);
  for (const std::uint32_t v : {0u, 127u, 128u, 300u, UINT32_MAX}) out.varint(v);
  out.bits(5, 3);
  out.bits(0, 0);
  out.bits(0x1ffff, 17);
  out.bits(UINT32_MAX, 32);
  out.align();
  out.text("end");

  ByteReader in(out.bytes(), "TEST");
  CHECK(in.u8() == 200);
  CHECK(in.u16() == 0xbeef);
  CHECK(in.u32() == 0xdeadbeef);
  CHECK(in.u64() == 0x0123456789abcdefull);
  CHECK(in.f32() == -1.5f);
  for (const std::uint32_t v : {0u, 127u, 128u, 300u, UINT32_MAX}) CHECK(in.varint() == v);
  CHECK(in.bits(3) == 5);
  CHECK(in.bits(0) == 0);
  CHECK(in.bits(17) == 0x1ffff);
  CHECK(in.bits(32) == UINT32_MAX);
  in.align();
  CHECK(in.text(3) == "end");
  in.check_end();
  CHECK_THROWS_AS(in.u8(), Failure);
}

TEST_CASE("numbers are little-endian in the file") {
  ByteWriter out;
  out.u32(0x01020304);
  CHECK(out.bytes() == std::vector{std::byte{4}, std::byte{3}, std::byte{2}, std::byte{1}});
}

TEST_CASE("a varint of more than 32 bits is refused") {
  const std::vector<std::byte> bytes(6, std::byte{0xff});
  ByteReader in(bytes, "TEST");
  CHECK_THROWS_AS(in.varint(), Failure);
}

TEST_CASE("an index needs no bits among one, and whole bits among more") {
  CHECK(index_bits(1) == 0);
  CHECK(index_bits(2) == 1);
  CHECK(index_bits(256) == 8);
  CHECK(index_bits(257) == 9);
}

TEST_CASE("sections are found by name, whatever their order") {
  constexpr ContainerKind kind{four_letters("TEST"), "test", 2, 3};
  const std::vector<ContainerSection> sections{{four_letters("AAAA"), {std::byte{1}}},
                                               {four_letters("BBBB"), {}}};
  const std::vector<std::byte> file = write_container(kind, sections);
  const Container container(file, kind);
  CHECK(container.version() == 3);
  CHECK(container_kind(file) == four_letters("TEST"));
  CHECK(container.section("AAAA").u8() == 1);
  CHECK(container.section("BBBB").remaining() == 0);
  CHECK_FALSE(container.has("CCCC"));
  CHECK_THROWS_WITH(container.section("CCCC"), "section CCCC is missing; bake the file again");

  constexpr ContainerKind later{four_letters("TEST"), "test", 4, 5};
  CHECK_THROWS_WITH(Container(file, later),
                    "the file's format version is too old (got 3, need 4 or newer); bake it again");
}
