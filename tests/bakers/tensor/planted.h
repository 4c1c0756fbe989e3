// Tensors with known answers.
#pragma once

#include <Eigen/QR>
#include <cmath>
#include <random>
#include <string>

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor::test {

inline float uniform(std::mt19937_64& bits) {
  return float(double(bits() >> 11) * 0x1p-52 - 1);
}  // -1 to 1

inline Matrix random_matrix(std::size_t rows, std::size_t columns, std::mt19937_64& bits) {
  Matrix m(rows, columns);
  for (Eigen::Index r = 0; r < m.rows(); ++r)
    for (Eigen::Index c = 0; c < m.cols(); ++c) m(r, c) = uniform(bits);
  return m;
}

inline Matrix random_basis(std::size_t rows, std::size_t columns, std::mt19937_64& bits) {
  const Eigen::MatrixXd m = random_matrix(rows, columns, bits).cast<double>();
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(m).householderQ();
  return q.leftCols(Eigen::Index(columns)).cast<float>();
}

inline Tensor random_tensor(const Dimensions& dimensions, std::mt19937_64& bits) {
  Tensor a(dimensions);
  for (float& v : a.data) v = uniform(bits);
  return a;
}

// Returns true if a is equal to b up to a relative error.
inline bool near(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b);
}

// The message of the Failure that the body throws; empty where it throws none.
template <class Body>
std::string failure_of(const Body& body) {
  try {
    body();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return {};
}

inline bool says(const std::string& message, const char* part) {
  return message.find(part) != std::string::npos;
}

// A sum of clusters with random cores and bases, and what it is made of.
struct Planted {
  Tensor a;
  std::vector<std::uint32_t> membership;  // I_m x K
};

// Sub-tensor i of mode m mixes the clusters i % C to (i + K - 1) % C.
inline Planted planted_clusters(const Dimensions& dimensions, const std::vector<std::size_t>& ranks,
                                std::size_t mode, std::size_t clusters, std::size_t mixture,
                                std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  Planted planted{Tensor(dimensions), {}};
  for (std::size_t i = 0; i < dimensions[mode]; ++i)
    for (std::size_t k = 0; k < mixture; ++k) planted.membership.push_back(std::uint32_t((i + k) % clusters));
  for (std::size_t c = 0; c < clusters; ++c) {
    std::vector<Matrix> bases;
    for (std::size_t n = 0; n < dimensions.size(); ++n)
      bases.push_back(random_basis(dimensions[n], ranks[n], bits));
    bases[mode] = random_matrix(dimensions[mode], ranks[mode], bits);
    for (std::size_t i = 0; i < dimensions[mode]; ++i)
      if ((c + clusters - i % clusters) % clusters >= mixture) bases[mode].row(Eigen::Index(i)).setZero();
    const Tensor part = mode_products(random_tensor(ranks, bits), bases);
    for (std::size_t e = 0; e < part.data.size(); ++e) planted.a.data[e] += part.data[e];
  }
  return planted;
}

}  // namespace nook::bake::tensor::test
