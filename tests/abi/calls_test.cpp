// The C interface as a C program uses it.
#include "tests/abi/host.h"
#include "tests/catch.h"

extern "C" int nook_call_everything(const void* bytes, size_t size);

std::vector<std::byte> nook_test_model_bytes() {
  return nook::test::Host().bytes;
}

TEST_CASE("a C program calls every function") {
  const nook::test::Host host;
  CHECK(nook_call_everything(host.bytes.data(), host.bytes.size()) == 0);
}
