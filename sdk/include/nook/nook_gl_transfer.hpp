// C++17 wrappers of radiance transfer in OpenGL: nook_gl_transfer.h.
#ifndef NOOK_GL_TRANSFER_HPP
#define NOOK_GL_TRANSFER_HPP

#include <cstdint>
#include <vector>

#include "nook_gl.hpp"
#include "nook_gl_transfer.h"
#include "nook_transfer.hpp"

namespace nook {
inline namespace wrapper {

// Every function and the destructor belong to the context thread, as for Gl.
class GlTransfer : public Unique<nook_gl_transfer, nook_gl_transfer_destroy> {
 public:
  GlTransfer() = default;
  GlTransfer(const Gl& gl, const TransferResponse& response, std::uint32_t vertex_count)
      : Unique(create(gl, response, vertex_count)) {}

  // A transfer in the paper's form, whose vertices the GPU keeps.
  GlTransfer(const Gl& gl, const Transfer& transfer, const TransferResponse& response)
      : Unique(create(gl, transfer, response)) {}

  // Of amplitudes of lobes, in the paper's form.
  void update_light(const std::vector<float>& amplitudes) {
    check(nook_gl_transfer_update_light(get(), amplitudes.data(), std::uint32_t(amplitudes.size() / 3)));
  }
  void update(const std::vector<float>& vectors) {
    check(nook_gl_transfer_update(get(), vectors.data(), vectors.size()));
  }
  nook_gl_transfer_info info() const {
    nook_gl_transfer_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_transfer_describe(get(), &info));
    return info;
  }

 private:
  static nook_gl_transfer create(const Gl& gl, const TransferResponse& response, std::uint32_t vertex_count) {
    nook_gl_transfer handle = nullptr;
    check(nook_gl_transfer_create(gl.get(), response.get(), vertex_count, &handle));
    return handle;
  }
  static nook_gl_transfer create(const Gl& gl, const Transfer& transfer, const TransferResponse& response) {
    nook_gl_transfer handle = nullptr;
    check(nook_gl_transfer_create_paper(gl.get(), transfer.get(), response.get(), &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
