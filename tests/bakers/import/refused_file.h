// The message with which the import refuses a file.
#pragma once

#include <string>

#include "bakers/import/gltf.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/import/gltf_builder.h"
#include "tests/catch.h"

namespace nook::test {

// Empty where the import succeeds.
template <class Import>
std::string failure_when(Import&& import) {
  try {
    import();
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    return failure.what();
  }
  return "";
}

inline std::string failure_of(const GltfBuilder& file) {
  return failure_when([&] { bake::import_gltf(file.glb()); });
}

}  // namespace nook::test
