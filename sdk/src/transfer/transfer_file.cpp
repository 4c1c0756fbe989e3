#include "sdk/src/transfer/transfer_file.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "sdk/src/transfer/check.h"

namespace nook::transfer {
namespace {

constexpr std::size_t frame_bytes = 6;

void read_head(ByteReader in, Transfer& transfer, std::uint32_t& vertices) {
  const std::uint32_t form = in.u8(), bounces = in.u8();
  if (form != 0 || bounces != 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the form of the transfer is unknown (got form %u with %u bounces, need 0 with 0); use a "
                  "newer library",
                  form, bounces);
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
  head.u8(0);
  head.u16(transfer.lobes);
  head.u32(transfer.vertex_count());
  for (const std::uint64_t hash :
       {transfer.hashes.position, transfer.hashes.normal, transfer.hashes.tangent, transfer.hashes.uv})
    head.u64(hash);
  for (const PackedFrame& frame : transfer.frames)
    for (const std::uint16_t number : {frame.u, frame.v, frame.angle}) frames.u16(number);
  recipe.text(transfer.recipe);
  std::vector<std::byte> shares(transfer.shares.size());
  std::transform(transfer.shares.begin(), transfer.shares.end(), shares.begin(),
                 [](std::uint8_t share) { return std::byte(share); });
  const ContainerSection sections[] = {{four_letters("HEAD"), head.bytes()},
                                       {four_letters("SHAR"), std::move(shares)},
                                       {four_letters("FRAM"), frames.bytes()},
                                       {four_letters("RECP"), recipe.bytes()}};
  return write_container(transfer_kind, sections);
}

Transfer read_transfer(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, transfer_kind);
  Transfer transfer(memory);
  std::uint32_t vertices = 0;
  read_head(file.section("HEAD"), transfer, vertices);
  ByteReader shares = file.section("SHAR"), frames = file.section("FRAM");
  shares.check_count(vertices, std::size_t(8) * transfer.lobes, "shares");
  frames.check_count(vertices, 8 * frame_bytes, "frames");
  const std::string_view text = shares.text(std::size_t(vertices) * transfer.lobes);
  shares.check_end();
  transfer.shares.resize(text.size());
  std::transform(text.begin(), text.end(), transfer.shares.begin(), [](char c) { return std::uint8_t(c); });
  transfer.frames.resize(vertices);
  for (PackedFrame& frame : transfer.frames) {
    frame.u = std::uint16_t(frames.u16());
    frame.v = std::uint16_t(frames.u16());
    frame.angle = std::uint16_t(frames.u16());
  }
  frames.check_end();
  ByteReader recipe = file.section("RECP");
  transfer.recipe = recipe.text(recipe.remaining());
  check_transfer(transfer, NOOK_ERROR_BAD_FILE);
  return transfer;
}

}  // namespace nook::transfer
