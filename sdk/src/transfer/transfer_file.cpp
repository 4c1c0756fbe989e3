#include "sdk/src/transfer/transfer_file.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/transfer/check.h"

namespace nook::transfer {
namespace {

constexpr std::size_t frame_bytes = 6;

enum Code : std::uint32_t { dark = 0, open = 1, partly = 2 };

void write_shares(const Transfer& transfer, ByteWriter& codes, ByteWriter& shares) {
  for (std::size_t v = 0; v < transfer.frames.size(); ++v) {
    const std::uint8_t* const of_vertex = transfer.shares_of(v);
    for (std::uint32_t first = 0; first < transfer.lobes; first += 4) {
      std::uint32_t byte = 0;
      for (std::uint32_t k = 0; k < 4 && first + k < transfer.lobes; ++k) {
        const std::uint32_t share = of_vertex[first + k];
        const Code code = share == 0 ? dark : share == 255 ? open : partly;
        byte |= code << (2 * k);
        if (code == partly) shares.u8(share);
      }
      codes.u8(byte);
    }
  }
}

void read_shares(ByteReader& codes, ByteReader& shares, std::uint32_t vertices, Transfer& transfer) {
  const std::size_t row = (transfer.lobes + 3) / 4;
  codes.check_count(vertices, 8 * row, "codes");
  const std::string_view packed = codes.text(vertices * row);
  codes.check_end();
  const std::string_view bytes = shares.text(shares.remaining());
  transfer.shares.resize(std::size_t(vertices) * transfer.lobes);
  std::size_t next = 0;
  for (std::size_t v = 0; v < vertices; ++v)
    for (std::uint32_t j = 0; j < transfer.lobes; ++j) {
      const auto byte = static_cast<unsigned char>(packed[v * row + j / 4]);
      const std::uint32_t code = std::uint32_t(byte) >> (2 * (j % 4)) & 3u;
      if (code > partly || (code == partly && next == bytes.size()))
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "the share of lobe %u at vertex %zu is unknown or missing; bake the file again", j, v);
      std::uint8_t& share = transfer.shares[v * transfer.lobes + j];
      share = code == partly ? std::uint8_t(bytes[next++])
              : code == open ? std::uint8_t(255)
                             : std::uint8_t(0);
    }
  if (next != bytes.size())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section SHAR is too long (%zu bytes are left over); bake the file again",
                  bytes.size() - next);
}

void read_head(ByteReader in, Transfer& transfer, std::uint32_t& vertices) {
  const std::uint32_t form = in.u8(), bounces = in.u8();
  if (form != 0 || bounces > max_bounces)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "the form of the transfer is unknown (got form %u with %u bounces, need 0 with 0 to %u); use "
        "a newer library",
        form, bounces, max_bounces);
  transfer.bounces = bounces;
  transfer.lobes = in.u16();
  vertices = in.u32();
  for (std::uint64_t* hash :
       {&transfer.hashes.position, &transfer.hashes.normal, &transfer.hashes.tangent, &transfer.hashes.uv})
    *hash = in.u64();
  in.check_end();
  check_lobes(transfer.lobes, NOOK_ERROR_BAD_FILE);
}

}  // namespace

std::vector<std::byte> write_transfer(const Transfer& transfer) {
  check_transfer(transfer, NOOK_ERROR_INVALID_ARGUMENT);
  ByteWriter head, frames, recipe;
  head.u8(0);
  head.u8(transfer.bounces);
  head.u16(transfer.lobes);
  head.u32(transfer.vertex_count());
  for (const std::uint64_t hash :
       {transfer.hashes.position, transfer.hashes.normal, transfer.hashes.tangent, transfer.hashes.uv})
    head.u64(hash);
  for (const PackedFrame& frame : transfer.frames)
    for (const std::uint16_t number : {frame.u, frame.v, frame.angle}) frames.u16(number);
  recipe.text(transfer.recipe);
  ByteWriter codes, shares;
  write_shares(transfer, codes, shares);
  std::vector<ContainerSection> sections{{four_letters("HEAD"), head.bytes()},
                                         {four_letters("CODE"), codes.bytes()},
                                         {four_letters("SHAR"), shares.bytes()},
                                         {four_letters("FRAM"), frames.bytes()},
                                         {four_letters("RECP"), recipe.bytes()}};
  if (transfer.bounces > 0) {
    ByteWriter indirect;
    for (const std::uint16_t half : transfer.indirect) indirect.u16(half);
    sections.push_back({four_letters("INDI"), indirect.bytes()});
  }
  if (transfer.votf_hash != 0) {
    ByteWriter holes;
    holes.u64(transfer.votf_hash);
    sections.push_back({four_letters("HOLE"), holes.bytes()});
  }
  return write_container(transfer_kind, sections);
}

Transfer read_transfer(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, transfer_kind);
  Transfer transfer(memory);
  std::uint32_t vertices = 0;
  read_head(file.section("HEAD"), transfer, vertices);
  ByteReader codes = file.section("CODE"), shares = file.section("SHAR"), frames = file.section("FRAM");
  frames.check_count(vertices, 8 * frame_bytes, "frames");
  read_shares(codes, shares, vertices, transfer);
  transfer.frames.resize(vertices);
  for (PackedFrame& frame : transfer.frames) {
    frame.u = std::uint16_t(frames.u16());
    frame.v = std::uint16_t(frames.u16());
    frame.angle = std::uint16_t(frames.u16());
  }
  frames.check_end();
  if (transfer.bounces > 0) {
    ByteReader indirect = file.section("INDI");
    const std::size_t each = std::size_t(transfer.bounces) * band_count;
    indirect.check_count(vertices, 16 * each, "reflected light");
    transfer.indirect.resize(vertices * each);
    for (std::uint16_t& half : transfer.indirect) half = std::uint16_t(indirect.u16());
    indirect.check_end();
  }
  if (file.has("HOLE")) {
    ByteReader holes = file.section("HOLE");
    transfer.votf_hash = holes.u64();
    holes.check_end();
  }
  ByteReader recipe = file.section("RECP");
  transfer.recipe = recipe.text(recipe.remaining());
  check_transfer(transfer, NOOK_ERROR_BAD_FILE);
  return transfer;
}

}  // namespace nook::transfer
