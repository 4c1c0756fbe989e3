#include "sdk/src/probe/probe_file.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sdk/src/core/floats.h"
#include "tests/catch.h"
#include "tests/probe/probe_sample.h"

using namespace nook;
using namespace nook::probe;

namespace {

constexpr Packing packings[] = {Packing::float32, Packing::half, Packing::rgb9e5};

nook_result read_result(std::span<const std::byte> bytes) {
  try {
    read_probes(bytes);
  } catch (const Failure& failure) {
    return failure.code();
  }
  return NOOK_OK;
}

}  // namespace

TEST_CASE("probes come back from their file") {
  for (const Probes& probes : test::all_sample_probes()) {
    for (const Packing packing : packings) {
      const std::vector<std::byte> file = write_probes(probes, packing);
      const Probes read = read_probes(file);
      CHECK(read.basis == probes.basis);
      CHECK(read.grid == probes.grid);
      CHECK(read.recipe == probes.recipe);
      CHECK(packing_of(file) == packing);
      REQUIRE(read.coefficients.size() == probes.coefficients.size());
      for (std::size_t i = 0; i < read.coefficients.size(); ++i) {
        const Vec3 a = read.coefficients[i], b = probes.coefficients[i];
        const float largest = std::max({b.x, b.y, b.z});
        // The errors that nook_probe.h states.
        const float bound = packing == Packing::float32 ? 0.0f
                            : packing == Packing::half  ? 0x1p-11f
                                                        : 0x1p-9f;
        CHECK(std::abs(a.x - b.x) <= bound * largest);
        CHECK(std::abs(a.y - b.y) <= bound * largest);
        CHECK(std::abs(a.z - b.z) <= bound * largest);
      }
      CHECK(read.has_gloss() == probes.has_gloss());
      // The sample's amplitudes are exact in every packing.
      CHECK(std::equal(read.gloss.begin(), read.gloss.end(), probes.gloss.begin(), probes.gloss.end()));
      CHECK(write_probes(read, packing) == file);  // packing what was packed changes nothing
    }
    CHECK(write_probes(probes, Packing::half).size() < write_probes(probes, Packing::float32).size());
  }
}

TEST_CASE("a probe file cut or flipped at any byte is refused") {
  for (const Probes& probes : test::all_sample_probes()) {
    const std::vector<std::byte> good = write_probes(probes, Packing::half);
    for (std::size_t i = 0; i < good.size(); ++i) {
      const std::vector<std::byte> cut(good.begin(), good.begin() + std::ptrdiff_t(i));
      REQUIRE(read_result(cut) == NOOK_ERROR_BAD_FILE);
      auto flipped = good;
      flipped[i] ^= std::byte{0x81};
      REQUIRE(read_result(flipped) != NOOK_OK);
    }
  }
}

TEST_CASE("a probe file flipped with its checksum repaired is refused or sound") {
  for (const Probes& probes : test::all_sample_probes()) {
    const std::vector<std::byte> good = write_probes(probes, Packing::float32);
    std::size_t refused = 0;
    for (std::size_t i = 0; i < good.size(); ++i)
      for (const unsigned flip : {0x01u, 0x40u, 0x80u, 0xffu}) {
        auto file = good;
        file[i] ^= std::byte(flip);
        repair_checksum(file);
        try {
          check_probes(read_probes(file), NOOK_ERROR_INTERNAL);
        } catch (const Failure& failure) {
          REQUIRE((failure.code() == NOOK_ERROR_BAD_FILE || failure.code() == NOOK_ERROR_FILE_VERSION));
          ++refused;
        }
      }
    CHECK(refused > 0);
  }
}

TEST_CASE("coefficients that a packing cannot hold are not written") {
  const auto refused = [](Vec3 bad, Packing packing, const char* part) {
    Probes probes = test::sample_probes(vogel_basis(3));
    probes.coefficients[1] = bad;
    try {
      write_probes(probes, packing);
      FAIL("written");
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
      CHECK(std::string(failure.what()).find(part) != std::string::npos);
    }
  };
  refused({0, -1, 0}, Packing::rgb9e5, "coefficient 1 of probe 0 does not fit RGB9E5 (got -1");
  refused({0, 7e4f, 0}, Packing::rgb9e5, "got 70000");
  refused({0, 0, -7e4f}, Packing::half, "too large for half floats");
  for (const Packing packing : packings) {
    refused({NAN, 0, 0}, packing, "out of range");
    refused({0, INFINITY, 0}, packing, "out of range");
  }
}

TEST_CASE("amplitudes for gloss that no bake makes are neither written nor read") {
  const auto refused = [](const Probes& probes, const char* part) {
    try {
      write_probes(probes, Packing::half);
      FAIL("written");
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
      CHECK(std::string(failure.what()).find(part) != std::string::npos);
    }
  };
  Probes probes = test::sample_gloss();
  probes.gloss[1].y = -1;
  refused(probes, "gloss amplitude 1 of probe 0 is out of range (got -1");
  probes.gloss[1].y = 7e4f;
  refused(probes, "too large for this packing (got 70000");
  probes.gloss.pop_back();
  refused(probes, "number of gloss amplitudes is wrong (got 5, need 6");
  Probes harmonics = test::sample_probes(harmonic_basis(2));
  harmonics.gloss.resize(harmonics.coefficients.size());
  refused(harmonics, "number of gloss amplitudes is wrong");
  // A minus sign in the file is found behind its checksum.
  const Probes good = test::sample_gloss();
  std::vector<std::byte> file = write_probes(good, Packing::float32);
  const auto* first = reinterpret_cast<const std::byte*>(good.gloss.data());
  const auto at = std::search(file.begin(), file.end(), first, first + 24);
  REQUIRE(at != file.end());
  *(at + 7) |= std::byte{0x80};
  repair_checksum(file);
  CHECK(read_result(file) == NOOK_ERROR_BAD_FILE);
}

TEST_CASE("a file with two equal lobes is refused by name") {
  Probes probes = test::sample_probes(vogel_basis(3));
  std::vector<std::byte> file = write_probes(probes, Packing::float32);
  // The lobes' section is 16 bytes a lobe: copy the first over the third.
  const auto lobe = [&](std::uint32_t i) {
    const float* axis = &probes.basis.axis[i].x;
    const auto* first = reinterpret_cast<const std::byte*>(axis);
    return std::search(file.begin(), file.end(), first, first + 12);
  };
  REQUIRE(lobe(2) != file.end());
  std::copy_n(lobe(0), 16, lobe(2));
  repair_checksum(file);
  try {
    read_probes(file);
    FAIL("read");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    CHECK(std::string(failure.what()).find("lobe 2") == 0);
    CHECK(std::string(failure.what()).find("same function as lobe 0") != std::string::npos);
  }
}
