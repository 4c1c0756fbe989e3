// A mean that grows value by value.
#pragma once

namespace nook::bake::nnao {

struct Mean {
  double sum = 0, count = 0;

  void add(double value) {
    sum += value;
    count += 1;
  }
  void add(const Mean& other) {
    sum += other.sum;
    count += other.count;
  }
  // Returns 0 before the first value.
  double value() const { return count > 0 ? sum / count : 0; }
};

}  // namespace nook::bake::nnao
