// C++17 wrappers of probes: nook_probe.h.
#ifndef NOOK_PROBE_HPP
#define NOOK_PROBE_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nook_handle.hpp"
#include "nook_probe.h"

namespace nook {
inline namespace wrapper {

inline nook_probe_fit_desc probe_fit_desc() {
  nook_probe_fit_desc desc;
  check(nook_probe_fit_desc_init(&desc));
  return desc;
}

// Set exactly one of these: `fits`; `lobes`; or the pair `functions` and `coefficients`.
inline nook_probe_desc probe_desc() {
  nook_probe_desc desc;
  check(nook_probe_desc_init(&desc));
  return desc;
}

class Probe : public Unique<nook_probe, nook_probe_destroy> {
 public:
  Probe() = default;
  explicit Probe(nook_probe handle) noexcept : Unique(handle) {}
  Probe(const Context& context, const void* bytes, std::size_t size) : Unique(load(context, bytes, size)) {}
  Probe(const Context& context, const nook_probe_desc& desc) : Unique(create(context, desc)) {}

  nook_probe_info info() const {
    nook_probe_info info{};
    info.struct_size = sizeof info;
    check(nook_probe_describe(get(), &info));
    return info;
  }
  // Returns the bytes of a .nook file.
  std::vector<unsigned char> save(nook_probe_packing packing) const {
    std::size_t size = 0;
    check(nook_probe_save(get(), packing, nullptr, &size));
    std::vector<unsigned char> bytes(size);
    check(nook_probe_save(get(), packing, bytes.data(), &size));
    return bytes;
  }
  // Returns the RGB coefficients of all functions.
  std::vector<float> coefficients(std::uint32_t index = 0) const {
    std::vector<float> rgb(std::size_t(3) * info().function_count);
    check(nook_probe_read_coefficients(get(), index, rgb.data(), static_cast<std::uint32_t>(rgb.size() / 3)));
    return rgb;
  }
  // If `position_ws` is NULL, returns the lobes of the first probe.
  std::vector<nook_lobe> lobes(const float* position_ws = nullptr) const {
    std::vector<nook_lobe> all(info().function_count);
    check(nook_probe_read_lobes(get(), position_ws, all.data(), static_cast<std::uint32_t>(all.size())));
    return all;
  }
  // `positions_ws` has a position for each direction. If it is NULL, the first probe is used.
  void radiance(const float* positions_ws, const float* directions, float* rgb, std::size_t count) const {
    check(nook_probe_radiance(get(), positions_ws, directions, rgb, count));
  }
  // `positions_ws` has a position for each normal. If it is NULL, the first probe is used.
  void irradiance(const float* positions_ws, const float* normals, float* rgb, std::size_t count) const {
    check(nook_probe_irradiance(get(), positions_ws, normals, rgb, count));
  }

 private:
  static nook_probe load(const Context& context, const void* bytes, std::size_t size) {
    nook_probe handle = nullptr;
    check(nook_probe_load(context.get(), bytes, size, &handle));
    return handle;
  }
  static nook_probe create(const Context& context, const nook_probe_desc& desc) {
    nook_probe handle = nullptr;
    check(nook_probe_create(context.get(), &desc, &handle));
    return handle;
  }
};

class ProbeFit : public Unique<nook_probe_fit, nook_probe_fit_destroy> {
 public:
  explicit ProbeFit(const Context& context, const nook_probe_fit_desc& desc = probe_fit_desc())
      : Unique(create(context, desc)) {}

  // `weights` may be NULL if all weights are 1.
  void add_samples(const float* directions, const float* radiance, const float* weights, std::size_t count) {
    check(nook_probe_fit_add_samples(get(), directions, radiance, weights, count));
  }
  void merge(const ProbeFit& other) { check(nook_probe_fit_merge(get(), other.get())); }
  void reset() { check(nook_probe_fit_reset(get())); }
  nook_probe_fit_info info() const {
    nook_probe_fit_info info{};
    info.struct_size = sizeof info;
    check(nook_probe_fit_describe(get(), &info));
    return info;
  }
  Probe solve() const {
    nook_probe handle = nullptr;
    check(nook_probe_fit_solve(get(), &handle));
    return Probe(handle);
  }

 private:
  static nook_probe_fit create(const Context& context, const nook_probe_fit_desc& desc) {
    nook_probe_fit handle = nullptr;
    check(nook_probe_fit_create(context.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
