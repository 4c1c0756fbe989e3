#include "sdk/src/transfer/transfer_file.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/transfer/transfer_check.h"

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
                      "the stored share of lobe %u at vertex %zu has an unknown code or is missing; bake the "
                      "file again",
                      j, v);
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

void add_separated(const Transfer& transfer, std::vector<ContainerSection>& sections) {
  ByteWriter codes, shares, frames;
  write_shares(transfer, codes, shares);
  for (const PackedFrame& frame : transfer.frames)
    for (const std::uint16_t number : {frame.u, frame.v, frame.angle}) frames.u16(number);
  sections.push_back({four_letters("CODE"), codes.bytes()});
  sections.push_back({four_letters("SHAR"), shares.bytes()});
  sections.push_back({four_letters("FRAM"), frames.bytes()});
}

std::vector<std::byte> bytes_of(std::span<const std::uint16_t> halves) {
  ByteWriter out;
  for (const std::uint16_t half : halves) out.u16(half);
  return out.bytes();
}

void add_paper(const PaperTransfer& paper, std::vector<ContainerSection>& sections) {
  ByteWriter head, clusters;
  for (const std::uint32_t number : {paper.light_modes, paper.clusters, paper.lobe_rank, paper.vertex_rank})
    head.u16(number);
  head.u64(paper.light_hash);
  head.f32(paper.scale);
  for (const std::uint8_t cluster : paper.cluster) clusters.u8(cluster);
  sections.push_back({four_letters("PAPR"), head.bytes()});
  sections.push_back({four_letters("LOBE"), bytes_of(paper.lobe_basis)});
  sections.push_back({four_letters("CORE"), bytes_of(paper.cores)});
  sections.push_back({four_letters("CLUS"), clusters.bytes()});
  sections.push_back({four_letters("COEF"), bytes_of(paper.coefficients)});
}

// Reads exactly `count` half floats. The size of the section is checked before memory is allocated.
void read_halves(ByteReader in, std::uint64_t count, Vector<std::uint16_t>& halves) {
  if (count != in.remaining() / 2 || in.remaining() % 2)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s has the wrong length (got %zu bytes, need %llu); bake the file again",
                  in.name(), in.remaining(), static_cast<unsigned long long>(2 * count));
  halves.resize(count);
  for (std::uint16_t& half : halves) half = std::uint16_t(in.u16());
}

void read_paper(const Container& file, std::uint32_t vertices, Transfer& transfer) {
  PaperTransfer& paper = transfer.paper;
  ByteReader head = file.section("PAPR"), clusters = file.section("CLUS");
  for (std::uint32_t* number : {&paper.light_modes, &paper.clusters, &paper.lobe_rank, &paper.vertex_rank})
    *number = head.u16();
  paper.light_hash = head.u64();
  paper.scale = head.f32();
  head.check_end();
  check_paper_head(paper, NOOK_ERROR_BAD_FILE);
  clusters.check_count(vertices, 8, "clusters");
  paper.cluster.resize(vertices);
  for (std::uint8_t& cluster : paper.cluster) cluster = std::uint8_t(clusters.u8());
  clusters.check_end();
  const std::uint64_t each = std::uint64_t(paper.clusters) * paper.lobe_rank;
  read_halves(file.section("LOBE"), each * transfer.lobes, paper.lobe_basis);
  read_halves(file.section("CORE"), each * 3 * paper.light_modes * paper.vertex_rank, paper.cores);
  read_halves(file.section("COEF"), std::uint64_t(vertices) * paper.vertex_rank, paper.coefficients);
}

void read_separated(const Container& file, std::uint32_t vertices, Transfer& transfer) {
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
}

void read_head(ByteReader in, Transfer& transfer, std::uint32_t& form, std::uint32_t& vertices) {
  form = in.u8();
  const std::uint32_t bounces = in.u8();
  if (form > 1 || bounces > max_bounces)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the form of the transfer is unknown (got form %u with %u bounces, need 0 or 1 with 0 to "
                  "%u); use a newer library",
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
  ByteWriter head, recipe;
  head.u8(transfer.paper.is_used() ? 1 : 0);
  head.u8(transfer.bounces);
  head.u16(transfer.lobes);
  head.u32(transfer.vertex_count());
  for (const std::uint64_t hash :
       {transfer.hashes.position, transfer.hashes.normal, transfer.hashes.tangent, transfer.hashes.uv})
    head.u64(hash);
  recipe.text(transfer.recipe);
  std::vector<ContainerSection> sections{{four_letters("HEAD"), head.bytes()}};
  if (transfer.paper.is_used())
    add_paper(transfer.paper, sections);
  else
    add_separated(transfer, sections);
  sections.push_back({four_letters("RECP"), recipe.bytes()});
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
  std::uint32_t form = 0, vertices = 0;
  read_head(file.section("HEAD"), transfer, form, vertices);
  if (form == 1)
    read_paper(file, vertices, transfer);
  else
    read_separated(file, vertices, transfer);
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
