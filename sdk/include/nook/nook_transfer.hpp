// C++17 wrappers of radiance transfer: nook_transfer.h.
#ifndef NOOK_TRANSFER_HPP
#define NOOK_TRANSFER_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nook_handle.hpp"
#include "nook_material.hpp"
#include "nook_transfer.h"

namespace nook {
inline namespace wrapper {

class Transfer : public Unique<nook_transfer, nook_transfer_destroy> {
 public:
  Transfer(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  nook_transfer_info info() const {
    nook_transfer_info info{};
    info.struct_size = sizeof info;
    check(nook_transfer_describe(get(), &info));
    return info;
  }

 private:
  static nook_transfer load(const Context& context, const void* bytes, std::size_t size) {
    nook_transfer handle = nullptr;
    check(nook_transfer_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

inline nook_transfer_map_desc transfer_map_desc() {
  nook_transfer_map_desc desc;
  check(nook_transfer_map_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

class TransferLight : public Unique<nook_transfer_light, nook_transfer_light_destroy> {
 public:
  TransferLight(const Context& context, const nook_transfer_map_desc& desc) : Unique(create(context, desc)) {}

 private:
  static nook_transfer_light create(const Context& context, const nook_transfer_map_desc& desc) {
    nook_transfer_light handle = nullptr;
    check(nook_transfer_light_create_map(context.get(), &desc, &handle));
    return handle;
  }
};

class TransferFit : public Unique<nook_transfer_fit, nook_transfer_fit_destroy> {
 public:
  TransferFit(const Context& context, std::uint32_t lobe_count)
      : Unique(create(context, lobe_count)), lobe_count_(lobe_count) {}

  // light_from_shape is a rotation of 9 floats, or NULL.
  std::vector<float> fit(const TransferLight& light, const float* light_from_shape = nullptr) const {
    std::vector<float> amplitudes(std::size_t(3) * lobe_count_);
    check(nook_transfer_fit_light(get(), light.get(), light_from_shape, amplitudes.data(), lobe_count_,
                                  nullptr));
    return amplitudes;
  }

 private:
  static nook_transfer_fit create(const Context& context, std::uint32_t lobe_count) {
    nook_transfer_fit handle = nullptr;
    check(nook_transfer_fit_create(context.get(), lobe_count, &handle));
    return handle;
  }

  std::uint32_t lobe_count_;
};

class TransferResponse : public Unique<nook_transfer_response, nook_transfer_response_destroy> {
 public:
  TransferResponse(const Context& context, const Material& material, std::uint32_t lobe_count)
      : Unique(create(context, material, lobe_count)) {}

  nook_transfer_response_info info() const {
    nook_transfer_response_info info{};
    info.struct_size = sizeof info;
    check(nook_transfer_response_describe(get(), &info));
    return info;
  }
  // The vectors of all vertices, without gaps.
  std::vector<float> vectors(const Transfer& transfer, const std::vector<float>& amplitudes) const {
    const std::uint32_t count = transfer.info().vertex_count;
    std::vector<float> out(std::size_t(count) * info().vector_floats);
    check(nook_transfer_vectors(transfer.get(), get(), amplitudes.data(),
                                static_cast<std::uint32_t>(amplitudes.size() / 3), 0, count, out.data(), 0));
    return out;
  }

 private:
  static nook_transfer_response create(const Context& context, const Material& material,
                                       std::uint32_t lobe_count) {
    nook_transfer_response_desc desc;
    check(nook_transfer_response_desc_init(&desc, sizeof desc, NOOK_VERSION));
    desc.material = material.get();
    desc.lobe_count = lobe_count;
    nook_transfer_response handle = nullptr;
    check(nook_transfer_response_create(context.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
