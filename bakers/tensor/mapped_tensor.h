// Tensors larger than memory, mapped from a file.
#pragma once

#include <cstdint>
#include <string>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// The entries of a tensor in a file: floats in the machine's byte order, row-major, from a byte offset that
// is a multiple of 4. Read-only; pages come and go as the system sees fit, so that a fit of a mapped tensor
// needs the memory of its reductions only. The file must not change meanwhile.
class MappedTensor {
 public:
  // Throws BAD_FILE where the file cannot be read or is too short, INVALID_ARGUMENT for a bad offset.
  MappedTensor(const std::string& path, std::uint64_t offset, Dimensions dimensions);
  ~MappedTensor();
  MappedTensor(const MappedTensor&) = delete;
  MappedTensor& operator=(const MappedTensor&) = delete;

  const TensorView& view() const { return view_; }

 private:
  void* map_ = nullptr;
  std::size_t bytes_ = 0;
  TensorView view_;
};

}  // namespace nook::bake::tensor
