// The C functions for baked shapes, material lobes and transfer vectors.
#include <array>
#include <cmath>
#include <span>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/material_handle.h"
#include "sdk/src/api/transfer_handles.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/transfer/transfer_check.h"
#include "sdk/src/transfer/transfer_file.h"
#include "sdk/src/transfer/vectors.h"

using namespace nook;
using namespace nook::transfer;

namespace {

Response response_of(const nook::material::MaterialTables& tables, std::uint32_t lobes, Memory* memory) {
  nook::material::refuse_neural(tables.neural.is_used(), "radiance transfer");
  const HemisphereCells cells(sharpness_of(lobes), memory);
  const std::size_t count = std::size_t(3) * tables.btf.light_modes;
  Vector<float> values(cells.direction.size() * count, 0.0f, memory);
  for (std::size_t i = 0; i < cells.direction.size(); ++i)
    nook::material::light_basis_at(tables, cells.direction[i], std::span(values).subspan(i * count, count));
  return make_response(lobes, cells,
                       {values, tables.btf.light_modes, nook::material::mean_reflectance(tables),
                        tables.light_hash, tables.votf_hash},
                       memory);
}

VectorOutput output_of(float* vectors, std::uint32_t count, std::uint32_t stride, const Response& response) {
  need(vectors, "vectors");
  const std::uint32_t floats = 3 * response.light_modes;
  if (stride != 0 && stride < floats)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "stride_floats is too small (got %u, need 0 or at least %u, the number of floats in a vector)",
        stride, floats);
  check_array("stride_floats", stride, sizeof(float));
  checked_stride("stride_floats", stride * sizeof(float), count, floats * sizeof(float));
  return {vectors, stride == 0 ? floats : stride};
}

Vec3 unit(const char* name, const float* v, std::uint32_t index) {
  const Vec3 d{v[0], v[1], v[2]};
  if (!(std::abs(length(d) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the %s of vertex %u is not of unit length (got %g %g %g)",
                  name, index, double(d.x), double(d.y), double(d.z));
  return d;
}

void need_finite(const float* values, std::size_t count, const char* what) {
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i]))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "element %zu of %s is not finite (got %g)", i, what,
                    double(values[i]));
}

MeshArrays arrays_of(const nook_transfer_mesh_desc& mesh) {
  const std::size_t count = mesh.vertex_count;
  const auto values = [&](const float* first, std::size_t each) {
    return first ? std::span<const float>(first, each * count) : std::span<const float>();
  };
  return {values(mesh.positions, 3), values(mesh.normals, 3), values(mesh.tangents, 4), values(mesh.uvs, 2),
          mesh.vertex_count};
}

void write_baked(const nook_transfer_response_s& response, const nook_transfer_vectors_desc& desc,
                 float* vectors, std::uint32_t vertex_count, std::uint32_t stride) {
  const Transfer& baked = desc.transfer->transfer;
  if (desc.normals || desc.tangents)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.transfer already contains the tangent frames; set desc.normals and desc.tangents to NULL");
  check_same_lobes(baked, desc.lobe_count);
  if (desc.first_vertex > baked.vertex_count() || vertex_count > baked.vertex_count() - desc.first_vertex)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the vertices are out of range (got %u vertices, starting at vertex %u, but the transfer "
                  "has only %u vertices)",
                  vertex_count, desc.first_vertex, baked.vertex_count());
  check_same_light(baked, response.response.light_modes, response.response.light_hash);
  const VectorOutput output = output_of(vectors, vertex_count, stride, response.response);
  baked_vectors(response.response, response.isa, {desc.amplitudes, std::size_t(3) * desc.lobe_count}, baked,
                desc.first_vertex, vertex_count, output, response.context->parallel(),
                response.context->memory());
}

void write_open(const nook_transfer_response_s& response, const nook_transfer_vectors_desc& desc,
                float* vectors, std::uint32_t vertex_count, std::uint32_t stride) {
  const VectorOutput output = output_of(vectors, vertex_count, stride, response.response);
  if (desc.first_vertex != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.first_vertex is %u, need 0 if desc.transfer is NULL",
                  desc.first_vertex);
  need(desc.normals, "desc.normals");
  need(desc.tangents, "desc.tangents");
  Vector<Frame> frames(response.context->memory());
  frames.reserve(vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const float* const t = desc.tangents + 4 * std::size_t(v);
    if (!(t[3] == 1 || t[3] == -1))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the tangent of vertex %u has a handedness that is neither 1 nor -1 (got %g)", v,
                    double(t[3]));
    frames.push_back(
        orthonormal_frame(unit("normal", desc.normals + 3 * std::size_t(v), v), unit("tangent", t, v), t[3]));
  }
  open_vectors(response.response, response.isa, {desc.amplitudes, std::size_t(3) * desc.lobe_count}, frames,
               output, response.context->parallel(), response.context->memory());
}

}  // namespace

nook_result nook_transfer_load(nook_context context, const void* bytes, size_t size, nook_transfer* out) {
  return api::enter("nook_transfer_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(bytes, "bytes");
    const auto shared = Ref<nook_context_s>::share(context);
    Transfer loaded = read_transfer({static_cast<const std::byte*>(bytes), size}, context->memory());
    *out = Owned<nook_transfer_s>::make(context->memory(), shared, context, std::move(loaded)).detach();
    context->log(NOOK_LOG_INFO, "radiance transfer: %u vertices, %u lobes, %zu bytes",
                 (*out)->transfer.vertex_count(), (*out)->transfer.lobes, size);
  });
}

void nook_transfer_destroy(nook_transfer* transfer) {
  if (!transfer || !*transfer) return;
  (*transfer)->release();
  *transfer = nullptr;
}

nook_result nook_transfer_describe(nook_transfer transfer, nook_transfer_info* info) {
  return api::enter("nook_transfer_describe", [&] {
    need(transfer, "transfer");
    nook_transfer_info known{};
    known.vertex_count = transfer->transfer.vertex_count();
    known.lobe_count = transfer->transfer.lobes;
    known.sharpness = sharpness_of(transfer->transfer.lobes);
    known.share_bytes = transfer->transfer.shares.size();
    known.bounces = transfer->transfer.bounces;
    known.has_holes = transfer->transfer.votf_hash != 0;
    const PaperTransfer& paper = transfer->transfer.paper;
    known.form = paper.is_used() ? NOOK_FORM_PAPER : NOOK_FORM_DEFAULT;
    known.light_modes = paper.light_modes;
    if (paper.is_used())
      known.paper_bytes = paper_bytes(known.vertex_count, paper.clusters, known.lobe_count, paper.light_modes,
                                      paper.lobe_rank, paper.vertex_rank);
    known.indirect_bytes = sizeof(std::uint16_t) * transfer->transfer.indirect.size();
    write_info(info, known);
  });
}

nook_result nook_transfer_read_frames(nook_transfer transfer, float* normals, float* tangents,
                                      uint32_t vertex_count) {
  return api::enter("nook_transfer_read_frames", [&] {
    need(transfer, "transfer");
    const Transfer& baked = transfer->transfer;
    if (baked.paper.is_used())
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "a transfer of the paper's form contains no tangent frames; use the normals and tangents "
                    "of your mesh");
    if (vertex_count != baked.vertex_count())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "vertex_count differs from the transfer's vertex count (got %u, need %u)", vertex_count,
                    baked.vertex_count());
    for (std::size_t v = 0; v < vertex_count; ++v) {
      const Frame frame = unpack(baked.frames[v]);
      const float numbers[7] = {frame.normal.x,  frame.normal.y,  frame.normal.z,  frame.tangent.x,
                                frame.tangent.y, frame.tangent.z, frame.handedness};
      if (normals) std::copy_n(numbers, 3, normals + 3 * v);
      if (tangents) std::copy_n(numbers + 3, 4, tangents + 4 * v);
    }
  });
}

nook_result nook_transfer_check(nook_transfer transfer, const nook_transfer_mesh_desc* mesh,
                                nook_material material) {
  return api::enter("nook_transfer_check", [&] {
    need(transfer, "transfer");
    if (mesh) check_same_mesh(transfer->transfer, arrays_of(read_descriptor(mesh)));
    if (!material) return;
    nook::material::refuse_neural(material->tables.neural.is_used(), "radiance transfer");
    check_same_light(transfer->transfer, material->tables.btf.light_modes, material->tables.light_hash);
    check_same_material(transfer->transfer, material->tables.votf_hash);
  });
}

nook_result nook_transfer_response_create(nook_context context, const nook_transfer_response_desc* desc,
                                          nook_transfer_response* out) {
  return api::enter("nook_transfer_response_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_transfer_response_desc d = read_descriptor(desc);
    need(d.material, "desc.material");
    check_lobes(d.lobe_count, NOOK_ERROR_INVALID_ARGUMENT);
    if (d.reserved != 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", d.reserved);
    const Isa isa = choose_isa(context->isa());
    const auto shared = Ref<nook_context_s>::share(context);
    *out = Owned<nook_transfer_response_s>::make(
               context->memory(), shared, context, isa,
               response_of(d.material->tables, d.lobe_count, context->memory()))
               .detach();
  });
}

void nook_transfer_response_destroy(nook_transfer_response* response) {
  if (!response || !*response) return;
  (*response)->release();
  *response = nullptr;
}

nook_result nook_transfer_response_describe(nook_transfer_response response,
                                            nook_transfer_response_info* info) {
  return api::enter("nook_transfer_response_describe", [&] {
    need(response, "response");
    nook_transfer_response_info known{};
    known.lobe_count = response->response.lobes;
    known.light_modes = response->response.light_modes;
    known.vector_floats = 3 * known.light_modes;
    known.table_bytes = response->response.table.size() * sizeof(float);
    const Vec3 share = response->response.reflectance;
    known.reflectance[0] = share.x;
    known.reflectance[1] = share.y;
    known.reflectance[2] = share.z;
    write_info(info, known);
  });
}

nook_result nook_transfer_read_vectors(nook_transfer_response response,
                                       const nook_transfer_vectors_desc* desc, float* vectors,
                                       uint32_t vertex_count, uint32_t stride_floats) {
  return api::enter("nook_transfer_read_vectors", [&] {
    need(response, "response");
    const nook_transfer_vectors_desc d = read_descriptor(desc);
    need(d.amplitudes, "desc.amplitudes");
    check_amplitudes(d.amplitudes, d.lobe_count, response->response.lobes);
    if (d.transfer)
      write_baked(*response, d, vectors, vertex_count, stride_floats);
    else
      write_open(*response, d, vectors, vertex_count, stride_floats);
  });
}

nook_result nook_transfer_shade(nook_material material, const nook_material_pixel* pixels,
                                const float* vectors, uint32_t vector_floats, uint32_t count,
                                float* radiance) {
  return api::enter("nook_transfer_shade", [&] {
    need(material, "material");
    nook::material::refuse_neural(material->tables.neural.is_used(), "radiance transfer");
    const std::uint32_t modes = material->tables.btf.light_modes;
    if (vector_floats != 3 * modes)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "vector_floats differs from the number that the material needs (got %u, need %u)",
                    vector_floats, 3 * modes);
    if (count == 0) return;
    need(pixels, "pixels");
    need(vectors, "vectors");
    need(radiance, "radiance");
    std::array<float, 3 * nook::material::max_directions + 3> decoded;
    for (std::size_t i = 0; i < count; ++i) {
      const nook_material_pixel& p = pixels[i];
      const float numbers[] = {p.uv[0], p.uv[1],   p.dx[0],   p.dx[1],  p.dy[0],
                               p.dy[1], p.view[0], p.view[1], p.view[2]};
      need_finite(numbers, std::size(numbers), "a pixel");
      const float* const vector = vectors + i * vector_floats;
      need_finite(vector, vector_floats, "a vector");
      const nook::material::Pixel pixel{{{p.uv[0], p.uv[1]}, {p.dx[0], p.dx[1]}, {p.dy[0], p.dy[1]}},
                                        {p.view[0], p.view[1], p.view[2]},
                                        {},
                                        1};
      nook::material::decode_pixel_modes(material->tables, pixel, std::span(decoded).first(modes));
      for (std::uint32_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (std::uint32_t a = 0; a < modes; ++a) sum += decoded[a] * vector[c * modes + a];
        radiance[3 * i + c] = sum;
      }
    }
  });
}
