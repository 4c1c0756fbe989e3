// C++17 wrappers of radiance transfer: nook_transfer.h.
#ifndef NOOK_TRANSFER_HPP
#define NOOK_TRANSFER_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../nook_gl.hpp"
#include "../nook_handle.hpp"
#include "../nook_material.hpp"
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
  // Throws if the mesh or the material differs from the bake. Pass NULL for the one that you do not want to
  // check.
  void check_baked(const nook_transfer_mesh_desc* mesh, const Material* material) const {
    check(nook_transfer_check(get(), mesh, material ? material->get() : nullptr));
  }

 private:
  static nook_transfer load(const Context& context, const void* bytes, std::size_t size) {
    nook_transfer handle = nullptr;
    check(nook_transfer_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

inline nook_transfer_light_desc transfer_light_desc() {
  nook_transfer_light_desc desc;
  check(nook_transfer_light_desc_init(&desc));
  return desc;
}

class TransferLight : public Unique<nook_transfer_light, nook_transfer_light_destroy> {
 public:
  TransferLight(const Context& context, const nook_transfer_light_desc& desc)
      : Unique(create(context, desc)) {}

  // `light_from_shape` is a rotation matrix of 9 floats, or NULL. Returns lobe_count x RGB.
  std::vector<float> project(std::uint32_t lobe_count, const float* light_from_shape = nullptr) const {
    std::vector<float> amplitudes(std::size_t(3) * lobe_count);
    check(nook_transfer_light_project(get(), lobe_count, light_from_shape, amplitudes.data(), nullptr));
    return amplitudes;
  }

 private:
  static nook_transfer_light create(const Context& context, const nook_transfer_light_desc& desc) {
    nook_transfer_light handle = nullptr;
    check(nook_transfer_light_create(context.get(), &desc, &handle));
    return handle;
  }
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
  // Returns the vectors of all vertices, without gaps.
  std::vector<float> vectors(const Transfer& transfer, const std::vector<float>& amplitudes) const {
    nook_transfer_vectors_desc desc;
    check(nook_transfer_vectors_desc_init(&desc));
    desc.transfer = transfer.get();
    desc.amplitudes = amplitudes.data();
    desc.lobe_count = static_cast<std::uint32_t>(amplitudes.size() / 3);
    const std::uint32_t count = transfer.info().vertex_count;
    std::vector<float> out(std::size_t(count) * info().vector_floats);
    check(nook_transfer_read_vectors(get(), &desc, out.data(), count, 0));
    return out;
  }

 private:
  static nook_transfer_response create(const Context& context, const Material& material,
                                       std::uint32_t lobe_count) {
    nook_transfer_response_desc desc;
    check(nook_transfer_response_desc_init(&desc));
    desc.material = material.get();
    desc.lobe_count = lobe_count;
    nook_transfer_response handle = nullptr;
    check(nook_transfer_response_create(context.get(), &desc, &handle));
    return handle;
  }
};

// Creates an upload for the vectors of `vertex_count` vertices.
inline Upload upload_transfer(const Gl& gl, const TransferResponse& response, std::uint32_t vertex_count) {
  nook_gl_upload handle = nullptr;
  check(nook_gl_upload_transfer(gl.get(), nullptr, response.get(), vertex_count, &handle));
  return Upload(handle);
}

// Creates an upload for a transfer. In the default form, the upload holds vectors. In the paper's form, it
// holds compressed vertices and the matrices of their clusters.
inline Upload upload_transfer(const Gl& gl, const Transfer& transfer, const TransferResponse& response) {
  nook_gl_upload handle = nullptr;
  check(nook_gl_upload_transfer(gl.get(), transfer.get(), response.get(), 0, &handle));
  return Upload(handle);
}

// Sets the light of an upload. `values` are the vectors, or in the paper's form the amplitudes of the lobes.
inline void update_transfer(const Upload& upload, const std::vector<float>& values) {
  check(nook_gl_update_transfer(upload.get(), values.data(), values.size()));
}

}  // namespace wrapper
}  // namespace nook
#endif
