// The paper's form: its vectors by their definition, its bytes, its files.
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/transfer/lit_rows.h"
#include "sdk/src/transfer/transfer_check.h"
#include "sdk/src/transfer/transfer_file.h"
#include "sdk/src/transfer/vectors.h"
#include "tests/catch.h"
#include "tests/transfer/transfer_sample.h"

using namespace nook;
using namespace nook::transfer;

namespace {

nook_result result_of(std::span<const std::byte> bytes) {
  try {
    read_transfer(bytes);
    return NOOK_OK;
  } catch (const Failure& failure) {
    return failure.code();
  }
}

double mebibytes(std::uint64_t bytes) {
  return double(bytes) / 1048576;
}

}  // namespace

TEST_CASE("the bytes of the paper's four scenes follow their vertices, clusters and lobes") {
  // Light modes of a colour: 16 of Sponge, 16 of Fiber + Sponge, and the means of two materials that the raw
  // data of the other scenes give. The paper has 15.77, 71.40, 18.79 and 29.44 MB.
  CHECK(mebibytes(paper_bytes(36000, 100, 642, 16, 64, 12)) == Approx(15.77).epsilon(0.01));
  CHECK(mebibytes(paper_bytes(98000, 180, 2562, 16, 64, 12)) == Approx(71.40).epsilon(0.01));
  // 3 R_l is 55 and 72 there.
  const auto bytes = [](double vertices, double clusters, double lobes, double all_modes) {
    return (clusters * (64 * lobes + 64 * all_modes * 12) * 2 + vertices * 25) / 1048576;
  };
  CHECK(bytes(55e3, 110, 642, 55) == Approx(18.79).epsilon(0.01));
  CHECK(bytes(75e3, 150, 642, 72) == Approx(29.44).epsilon(0.01));
}

TEST_CASE("vectors of the paper's form are the product of light, bases, core and coefficients") {
  const Transfer transfer = test::sample_paper();
  const PaperTransfer& p = transfer.paper;
  Response response(default_memory());
  response.lobes = 19;
  response.light_modes = 8;
  response.light_hash = 5;
  std::vector<float> amplitudes(3 * 19);
  for (std::size_t i = 0; i < amplitudes.size(); ++i) amplitudes[i] = std::sin(float(i));
  constexpr std::size_t stride = 30;
  std::vector<float> vectors(5 * stride, -7.0f);
  baked_vectors(response, Isa::scalar, amplitudes, transfer, 1, 5, {vectors.data(), stride}, {},
                default_memory());
  const auto at = [](const Vector<std::uint16_t>& halves, std::size_t i) {
    return double(from_half(halves[i]));
  };
  for (std::size_t v = 1; v < 6; ++v) {
    const std::size_t g = p.cluster[v];
    for (std::size_t i = 0; i < 24; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < 19; ++j)
        for (std::size_t k = 0; k < 5; ++k)
          for (std::size_t q = 0; q < 4; ++q)
            sum += double(amplitudes[3 * j + i / 8]) * at(p.lobe_basis, (g * 19 + j) * 5 + k) *
                   at(p.cores, ((g * 24 + i) * 4 + q) * 5 + k) * at(p.coefficients, v * 4 + q);
      CHECK(double(vectors[(v - 1) * stride + i]) == Approx(sum * 0.25).margin(1e-4));
    }
    for (std::size_t i = 24; i < stride; ++i) CHECK(vectors[(v - 1) * stride + i] == -7.0f);
  }
}

TEST_CASE("the rows of a light, weighed with a vertex's numbers, are its vector") {
  for (const std::uint32_t bounces : {0u, 1u, 2u}) {
    CAPTURE(bounces);
    const Transfer transfer = test::sample_paper(7, 19, 8, 5, bounces);
    Response response(default_memory());
    response.lobes = 19;
    response.light_modes = 8;
    response.light_hash = 5;
    response.reflectance = {0.5f, 0.25f, 0.8f};
    for (int i = 0; i < 24; ++i) response.even.push_back(0.1f * float(i) - 1);
    std::vector<float> amplitudes(3 * 19);
    for (std::size_t i = 0; i < amplitudes.size(); ++i) amplitudes[i] = std::sin(float(i));
    std::vector<float> vectors(7 * 24), rows(lit_row_count(transfer) * 24);
    baked_vectors(response, Isa::scalar, amplitudes, transfer, 0, 7, {vectors.data(), 24}, {},
                  default_memory());
    write_lit_rows(response, amplitudes, transfer, {}, default_memory(), rows);
    const std::size_t rank = transfer.paper.vertex_rank, count = vertex_number_count(transfer);
    CHECK(count % 4 == 0);
    for (std::size_t v = 0; v < 7; ++v) {
      std::vector<float> numbers(count, -1.0f);
      write_vertex_numbers(transfer, v, numbers.data());
      for (std::size_t i = 0; i < 24; ++i) {
        double sum = 0;
        for (std::size_t q = 0; q < rank; ++q)
          sum += double(numbers[1 + q]) * double(rows[(std::size_t(numbers[0]) * rank + q) * 24 + i]);
        for (std::size_t k = 0; k < bounces * band_count; ++k)
          sum += double(numbers[1 + rank + k]) * double(rows[(transfer.paper.clusters * rank + k) * 24 + i]);
        // Sums of floats in another order.
        CHECK(double(vectors[v * 24 + i]) == Approx(sum).margin(1e-4));
      }
      for (std::size_t k = 1 + rank + bounces * band_count; k < count; ++k) CHECK(numbers[k] == 0);
    }
  }
}

TEST_CASE("a file of the paper's form gives back what was written, and has the bytes of its formula") {
  const Transfer made = test::sample_paper(400, 162, 16, 77, 1);
  const std::vector<std::byte> bytes = write_transfer(made);
  const Transfer read = read_transfer(bytes);
  CHECK(read.vertex_count() == 400);
  CHECK(read.lobes == 162);
  CHECK(read.hashes == made.hashes);
  CHECK(read.indirect == made.indirect);
  CHECK(read.paper.light_modes == 16);
  CHECK(read.paper.light_hash == 77);
  CHECK(read.paper.scale == made.paper.scale);
  CHECK(read.paper.lobe_basis == made.paper.lobe_basis);
  CHECK(read.paper.cores == made.paper.cores);
  CHECK(read.paper.cluster == made.paper.cluster);
  CHECK(read.paper.coefficients == made.paper.coefficients);
  const std::size_t counted = paper_bytes(400, 3, 162, 16, 5, 4) + 400 * 18;
  // The head, the hashes, the table of sections and the recipe.
  CHECK(bytes.size() > counted);
  CHECK(bytes.size() < counted + 400);
}

TEST_CASE("files of the paper's form that are cut or changed are refused or harmless") {
  const std::vector<std::byte> bytes = write_transfer(test::sample_paper());
  for (std::size_t size = 0; size < bytes.size(); size += 3)
    CHECK(result_of(std::span(bytes).first(size)) == NOOK_ERROR_BAD_FILE);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const unsigned flip : {1u, 0x80u, 0x7cu, 0xffu}) {
      std::vector<std::byte> changed = bytes;
      changed[i] ^= std::byte(flip);
      repair_checksum(changed);
      const nook_result result = result_of(changed);
      CHECK((result == NOOK_OK || result == NOOK_ERROR_BAD_FILE || result == NOOK_ERROR_FILE_VERSION));
      refused += result != NOOK_OK;
    }
  CHECK(refused > 100);
}

TEST_CASE("numbers of the paper's form that are out of range are not written") {
  const auto refused = [](auto&& change) {
    Transfer transfer = test::sample_paper();
    change(transfer.paper);
    CHECK_THROWS_AS(write_transfer(transfer), Failure);
  };
  refused([](PaperTransfer& p) { p.cluster[3] = 3; });
  refused([](PaperTransfer& p) { p.cores[7] = 0x7c00; });
  refused([](PaperTransfer& p) { p.coefficients[7] = 0xfe00; });
  refused([](PaperTransfer& p) { p.lobe_basis.pop_back(); });
  refused([](PaperTransfer& p) { p.light_modes = 6; });
  refused([](PaperTransfer& p) { p.scale = NAN; });
  refused([](PaperTransfer& p) { p.scale = 0; });
  refused([](PaperTransfer& p) { p.scale = 1e4f; });
  refused([](PaperTransfer& p) { p.lobe_basis[5] = to_half(1.5f); });
}

TEST_CASE("the paper's form takes the light modes of its own material only") {
  const Transfer transfer = test::sample_paper();
  CHECK_NOTHROW(check_same_light(transfer, 8, 5));
  CHECK_THROWS_AS(check_same_light(transfer, 8, 6), Failure);
  CHECK_THROWS_AS(check_same_light(transfer, 16, 5), Failure);
  CHECK_NOTHROW(check_same_light(test::sample_transfer(), 16, 6));
}
