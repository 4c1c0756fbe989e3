#include <nook/experimental/nook_transfer.h>

#include <algorithm>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/upload.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/transfer/lit_rows.h"
#include "sdk/src/transfer/transfer_check.h"

using namespace nook;

namespace {

nook_gl_upload upload_paper(nook_gl gl, nook_transfer transfer, nook_transfer_response response) {
  transfer::check_same_light(transfer->transfer, response->response.light_modes,
                             response->response.light_hash);
  transfer::check_same_lobes(transfer->transfer, response->response.lobes);
  return api::make_upload<api::PaperUpload>(gl, gl::probe_users(gl->device.gl), transfer, response);
}

nook_gl_upload upload_vectors(nook_gl gl, nook_transfer_response response, std::uint32_t vertex_count) {
  check_range("vertex_count", vertex_count, 1, transfer::max_vertices);
  return api::make_upload<gl::TransferTexture>(gl, gl::probe_users(gl->device.gl),
                                               response->response.light_modes, vertex_count);
}

void check_count(std::uint64_t float_count, std::uint64_t needed) {
  if (float_count != needed)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "float_count differs from the upload's number of floats (got %llu, need %llu)",
                  static_cast<unsigned long long>(float_count), static_cast<unsigned long long>(needed));
}

void update_vectors(nook_gl_s& gl, gl::TransferTexture& texture, const float* vectors,
                    std::uint64_t float_count) {
  check_count(float_count, texture.float_count());
  gl.device.report_host_errors();
  // This conversion cannot overflow, because a texture with exactly this many floats exists.
  const auto count = static_cast<std::size_t>(float_count);
  gl.guarded(gl::probe_users(gl.device.gl), [&] { texture.update({vectors, count}); });
}

void update_paper(nook_gl_s& gl, api::PaperUpload& paper, const float* amplitudes,
                  std::uint64_t float_count) {
  const transfer::Response& response = paper.response->response;
  check_count(float_count, std::uint64_t{3} * response.lobes);
  transfer::check_amplitudes(amplitudes, response.lobes, response.lobes);
  gl.device.report_host_errors();
  nook_context_s& context = *paper.response->context;
  const transfer::Transfer& baked = paper.baked->transfer;
  Vector<float> rows(transfer::lit_row_count(baked) * 3 * baked.paper.light_modes, 0.0f, context.memory());
  write_lit_rows(response, {amplitudes, std::size_t(3) * response.lobes}, baked, context.parallel(),
                 context.memory(), rows);
  gl.guarded(gl::probe_users(gl.device.gl), [&] {
    paper.texture.update([&](std::span<float> out) { std::copy(rows.begin(), rows.end(), out.begin()); });
  });
}

}  // namespace

nook_result nook_gl_upload_transfer(nook_gl gl, nook_transfer transfer, nook_transfer_response response,
                                    uint32_t vertex_count, nook_gl_upload* out) {
  return api::enter("nook_gl_upload_transfer", [&] {
    need(out, "out");
    *out = nullptr;
    need(gl, "gl");
    need(response, "response");
    if (transfer && transfer->transfer.paper.is_used())
      *out = upload_paper(gl, transfer, response);
    else
      *out = upload_vectors(gl, response, transfer ? transfer->transfer.vertex_count() : vertex_count);
  });
}

nook_result nook_gl_update_transfer(nook_gl_upload upload, const float* values, uint64_t float_count) {
  return api::enter("nook_gl_update_transfer", [&] {
    need(upload, "upload");
    need(values, "values");
    upload->gl->device.need_alive();
    if (gl::TransferTexture* const vectors = upload->vectors())
      update_vectors(*upload->gl, *vectors, values, float_count);
    else if (api::PaperUpload* const paper = upload->paper())
      update_paper(*upload->gl, *paper, values, float_count);
    else
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "upload is not a transfer; pass an upload that nook_gl_upload_transfer created");
  });
}
