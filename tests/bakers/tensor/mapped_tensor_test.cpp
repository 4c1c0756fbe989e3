#include "bakers/tensor/mapped_tensor.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/bakers/tensor/planted.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::tensor;

namespace {

// A file that is gone with the test.
struct TemporaryFile {
  TemporaryFile()
      : path(std::filesystem::temp_directory_path() / ("nook_tensor_" + std::to_string(std::rand()))) {}
  ~TemporaryFile() { std::filesystem::remove(path); }

  std::filesystem::path path;
};

}  // namespace

TEST_CASE("a tensor mapped from a file behind its header is the one that was written, and fits alike") {
  std::mt19937_64 bits(51);
  const Tensor a = test::random_tensor({6, 9, 7}, bits);
  const TemporaryFile file;
  std::ofstream(file.path, std::ios::binary)
      .write("header, 20 bytes    ", 20)
      .write(reinterpret_cast<const char*>(a.data.data()), std::streamsize(a.data.size() * sizeof(float)));
  const MappedTensor mapped(file.path, 20, a.dimensions);
  CHECK(squared_distance(mapped.view(), a) == 0);
  CHECK(fit_nsvd(mapped.view(), {{2, 3, 4}}).core.data == fit_nsvd(a, {{2, 3, 4}}).core.data);

  const auto message = [&](const std::string& path, std::uint64_t offset, const Dimensions& dimensions) {
    return test::failure_of([&] { MappedTensor(path, offset, dimensions); });
  };
  CHECK(test::says(message(file.path, 24, a.dimensions),
                   "too short for its tensor (got 1532 bytes, need 1536)"));
  CHECK(test::says(message(file.path, 20, {6, 9, 8}), "too short"));
  CHECK(test::says(message(file.path, 0, Dimensions(5, std::size_t(1) << 40)), "too short"));
  CHECK(test::says(message(file.path, 18, a.dimensions), "multiple of 4"));
  CHECK(test::says(message(file.path.string() + ".none", 0, a.dimensions), "cannot read"));
}
