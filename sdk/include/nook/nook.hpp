// C++17 wrappers of the C headers: handles destroy their objects, and failed calls throw nook::Error. The
// wrappers are header-only, so that no C++ type crosses the library's boundary. The C headers document every
// function, its thread contract included.
#ifndef NOOK_NOOK_HPP
#define NOOK_NOOK_HPP

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nook_character.h"
#include "nook_material.h"
#include "nook_nnao_recording.h"
#include "nook_pose.h"
#include "nook_probe.h"
#include "nook_transfer.h"
#include "nook_vertices.h"
// A library without its OpenGL half (NOOK_GL=OFF) is installed without these headers.
#if __has_include("nook_gl.h")
#define NOOK_HPP_GL 1
#include "nook_gl.h"
#include "nook_gl_material.h"
#include "nook_gl_probe.h"
#include "nook_gl_transfer.h"
#include "nook_nnao.h"
#include "nook_nnao_stages.h"
#endif

namespace nook {
// The inline namespace keeps these names apart from the library's own names at link time. Callers write
// nook::Scene.
inline namespace wrapper {

// A failed call: what() is the message of nook_last_message().
class Error : public std::runtime_error {
 public:
  explicit Error(nook_result result) : std::runtime_error(nook_last_message()), result_(result) {}
  nook_result result() const noexcept { return result_; }

 private:
  nook_result result_;
};

// Throws Error unless the call succeeded.
inline void check(nook_result result) {
  if (result != NOOK_OK) throw Error(result);
}

// Owns one handle; the C functions take get().
template <class Handle, void (*destroy)(Handle*)>
class Unique {
 public:
  Unique() = default;
  explicit Unique(Handle handle) noexcept : handle_(handle) {}
  Unique(Unique&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Unique& operator=(Unique&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Unique() { destroy(&handle_); }

  Handle get() const noexcept { return handle_; }
  explicit operator bool() const noexcept { return handle_ != nullptr; }

 private:
  Handle handle_ = nullptr;
};

inline nook_context_desc context_desc() {
  nook_context_desc desc;
  check(nook_context_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

inline nook_scene_desc scene_desc() {
  nook_scene_desc desc;
  check(nook_scene_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

inline nook_pose_desc pose_desc() {
  nook_pose_desc desc;
  check(nook_pose_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

inline nook_probe_fit_desc probe_fit_desc() {
  nook_probe_fit_desc desc;
  check(nook_probe_fit_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// The caller sets functions and coefficients.
inline nook_probe_desc probe_desc() {
  nook_probe_desc desc;
  check(nook_probe_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

class Context : public Unique<nook_context, nook_context_destroy> {
 public:
  explicit Context(const nook_context_desc& desc = context_desc()) : Unique(create(desc)) {}

 private:
  static nook_context create(const nook_context_desc& desc) {
    nook_context handle = nullptr;
    check(nook_context_create(&desc, &handle));
    return handle;
  }
};

class CharacterModel : public Unique<nook_character_model, nook_character_model_destroy> {
 public:
  CharacterModel() = default;
  CharacterModel(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  nook_character_model_info info() const {
    nook_character_model_info info{};
    info.struct_size = sizeof info;
    check(nook_character_model_describe(get(), &info));
    return info;
  }
  nook_character_memory memory() const {
    nook_character_memory memory{};
    memory.struct_size = sizeof memory;
    check(nook_character_model_memory(get(), &memory));
    return memory;
  }
  // Returns an empty string for an index out of range.
  std::string bone_name(std::uint32_t bone) const {
    const char* name = nook_character_model_bone_name(get(), bone);
    return name ? name : "";
  }
  std::vector<float> static_ao() const {
    std::vector<float> ao(info().file_vertex_count);
    check(nook_character_model_static_ao(get(), ao.data(), static_cast<std::uint32_t>(ao.size())));
    return ao;
  }
  // The transform of each bone, -1 where no name matches.
  std::vector<std::int32_t> map_bones(const std::vector<const char*>& names, std::uint32_t flags = 0) const {
    nook_bone_names rules{};
    rules.struct_size = sizeof rules;
    rules.flags = flags;
    rules.names = names.data();
    rules.name_count = static_cast<std::uint32_t>(names.size());
    std::vector<std::int32_t> map(info().bone_count);
    check(nook_character_model_map_bones(get(), &rules, map.data(), static_cast<std::uint32_t>(map.size()),
                                         nullptr));
    return map;
  }
  // Returns false past the last rest vertex.
  bool rest_vertex(std::uint32_t index, nook_rest_vertex& vertex) const {
    vertex.struct_size = sizeof vertex;
    return nook_character_model_rest_vertex(get(), index, &vertex) == NOOK_OK;
  }
  // Returns false past the last skin.
  bool skin(std::uint32_t index, nook_skin_info& skin) const {
    skin.struct_size = sizeof skin;
    return nook_character_model_skin(get(), index, &skin) == NOOK_OK;
  }
  // Fills the answers in `answer`.
  void check_pose(const nook_pose_desc& desc, nook_pose_check& answer) const {
    answer.struct_size = sizeof answer;
    wrapper::check(nook_character_model_check_pose(get(), &desc, &answer));
  }
  // The model in the order of a host's vertices; vertices[i] is this model's vertex for the host's vertex i.
  CharacterModel remap(const std::vector<std::uint32_t>& vertices) const {
    nook_character_model handle = nullptr;
    check(nook_character_model_remap(get(), vertices.data(), static_cast<std::uint32_t>(vertices.size()),
                                     &handle));
    return CharacterModel(handle);
  }

 private:
  explicit CharacterModel(nook_character_model handle) : Unique(handle) {}
  static nook_character_model load(const Context& context, const void* bytes, std::size_t size) {
    nook_character_model handle = nullptr;
    check(nook_character_model_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

class Scene : public Unique<nook_scene, nook_scene_destroy> {
 public:
  explicit Scene(const Context& context, const nook_scene_desc& desc = scene_desc())
      : Unique(create(context, desc)) {}

  nook_instance_id add_instance(const CharacterModel& model) {
    nook_instance_id id = 0;
    check(nook_scene_add_instance(get(), model.get(), &id));
    return id;
  }
  void remove_instance(nook_instance_id id) { check(nook_scene_remove_instance(get(), id)); }
  // The bone counts of both models are equal.
  void set_model(nook_instance_id id, const CharacterModel& model) {
    check(nook_scene_set_model(get(), id, model.get()));
  }
  // bones_3x4 holds 12 floats for each bone, row-major.
  void set_pose(nook_instance_id id, const float* bones_3x4, std::uint32_t bone_count) {
    check(nook_scene_set_pose(get(), id, bones_3x4, bone_count));
  }
  // The pose as a host has it; pose_desc() begins a description.
  void set_pose(nook_instance_id id, const nook_pose_desc& desc) {
    check(nook_scene_set_pose_from(get(), id, &desc));
  }
  void link(nook_instance_id receiver, nook_instance_id caster) {
    check(nook_scene_link(get(), receiver, caster));
  }
  void unlink(nook_instance_id receiver, nook_instance_id caster) {
    check(nook_scene_unlink(get(), receiver, caster));
  }
  void link_nearest(std::uint32_t k, float max_distance) {
    check(nook_scene_link_nearest(get(), k, max_distance));
  }
  void set_ground(nook_instance_id id, const float* plane_xyzd) {
    check(nook_scene_set_ground(get(), id, plane_xyzd));
  }
  nook_occluder_id add_occluder(const float centre_ws[3], float radius) {
    nook_occluder_id id = 0;
    check(nook_scene_add_occluder(get(), centre_ws, radius, &id));
    return id;
  }
  void set_occluder(nook_occluder_id id, const float centre_ws[3], float radius) {
    check(nook_scene_set_occluder(get(), id, centre_ws, radius));
  }
  void remove_occluder(nook_occluder_id id) { check(nook_scene_remove_occluder(get(), id)); }
  // receiver 0: every instance.
  void limit_occluder(nook_occluder_id id, nook_instance_id receiver) {
    check(nook_scene_limit_occluder(get(), id, receiver));
  }
  void set_camera(const float position_ws[3]) { check(nook_scene_set_camera(get(), position_ws)); }
  void set_terms(std::uint32_t terms) { check(nook_scene_set_terms(get(), terms)); }
  void update() { check(nook_scene_update(get())); }
  void read_ao(nook_instance_id id, float* out, std::uint32_t count, std::size_t stride = 0) const {
    check(nook_scene_read_ao(get(), id, out, count, stride));
  }
  void set_light(nook_instance_id id, const nook_probe_lobe* lobes, std::uint32_t lobe_count) {
    check(nook_scene_set_light(get(), id, lobes, lobe_count));
  }
  // Writes three floats for each vertex.
  void read_directional_ao(nook_instance_id id, float* out_rgb, std::uint32_t count,
                           std::size_t stride = 0) const {
    check(nook_scene_read_directional_ao(get(), id, out_rgb, count, stride));
  }
  std::uint64_t memory() const {
    std::uint64_t bytes = 0;
    check(nook_scene_memory(get(), &bytes));
    return bytes;
  }
  nook_scene_stats stats() const {
    nook_scene_stats stats{};
    stats.struct_size = sizeof stats;
    check(nook_scene_read_stats(get(), &stats));
    return stats;
  }

 private:
  static nook_scene create(const Context& context, const nook_scene_desc& desc) {
    nook_scene handle = nullptr;
    check(nook_scene_create(context.get(), &desc, &handle));
    return handle;
  }
};

// The caller sets the size, depth, the projection and the radius.
inline nook_nnao_recording_desc nnao_recording_desc() {
  nook_nnao_recording_desc desc;
  check(nook_nnao_recording_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// A recorded frame of the screen-space pass.
class Recording : public Unique<nook_nnao_recording, nook_nnao_recording_destroy> {
 public:
  Recording() = default;
  // Takes over a handle, such as that of nook_nnao_record.
  explicit Recording(nook_nnao_recording handle) noexcept : Unique(handle) {}
  Recording(const Context& context, const nook_nnao_recording_desc& desc) : Unique(create(context, desc)) {}
  Recording(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  // The pointers of the result are valid while this object lives.
  nook_nnao_recording_desc desc() const {
    nook_nnao_recording_desc desc{};
    desc.struct_size = sizeof desc;
    check(nook_nnao_recording_describe(get(), &desc));
    return desc;
  }
  std::vector<unsigned char> save() const {
    std::size_t size = 0;
    check(nook_nnao_recording_save(get(), nullptr, &size));
    std::vector<unsigned char> bytes(size);
    check(nook_nnao_recording_save(get(), bytes.data(), &size));
    return bytes;
  }
  // Writes the file beside its place and renames it, so that it appears whole or not at all. Throws
  // std::runtime_error with a text that names the file.
  void write(const std::filesystem::path& file) const {
    const std::vector<unsigned char> bytes = save();
    std::filesystem::path part = file;
    part += ".part";
    std::error_code error;
    std::ofstream out(part, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    bool written = static_cast<bool>(out);
    if (written) std::filesystem::rename(part, file, error);
    written = written && !error;
    if (!written) {
      std::filesystem::remove(part, error);
      throw std::runtime_error("nook::Recording::write: " + file.string() + " cannot be written");
    }
  }

 private:
  static nook_nnao_recording create(const Context& context, const nook_nnao_recording_desc& desc) {
    nook_nnao_recording handle = nullptr;
    check(nook_nnao_recording_create(context.get(), &desc, &handle));
    return handle;
  }
  static nook_nnao_recording load(const Context& context, const void* bytes, std::size_t size) {
    nook_nnao_recording handle = nullptr;
    check(nook_nnao_recording_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

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
  // position_ws may be NULL for the first probe.
  std::vector<nook_probe_lobe> lobes(const float* position_ws = nullptr) const {
    std::vector<nook_probe_lobe> all(info().function_count);
    check(nook_probe_read_lobes(get(), position_ws, all.data(), static_cast<std::uint32_t>(all.size())));
    return all;
  }
  void radiance(const float* position_ws, const float* directions, float* rgb, std::size_t count) const {
    check(nook_probe_radiance(get(), position_ws, directions, rgb, count));
  }
  void irradiance(const float* position_ws, nook_probe_irradiance_form form, const float* normals, float* rgb,
                  std::size_t count) const {
    check(nook_probe_irradiance(get(), position_ws, form, normals, rgb, count));
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

  // weights may be NULL if all are 1.
  void add_samples(const float* directions, const float* radiance, const float* weights, std::size_t count) {
    check(nook_probe_fit_add_samples(get(), directions, radiance, weights, count));
  }
  void seed(const ProbeFit& short_run) { check(nook_probe_fit_seed(get(), short_run.get())); }
  void merge(const ProbeFit& other) { check(nook_probe_fit_merge(get(), other.get())); }
  void reset() { check(nook_probe_fit_reset(get())); }
  nook_probe_fit_info info() const {
    nook_probe_fit_info info{};
    info.struct_size = sizeof info;
    check(nook_probe_fit_describe(get(), &info));
    return info;
  }
  // Returns the RGB coefficients of all functions.
  std::vector<float> read() const {
    std::vector<float> rgb(std::size_t(3) * info().function_count);
    check(nook_probe_fit_read(get(), rgb.data(), static_cast<std::uint32_t>(rgb.size() / 3)));
    return rgb;
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

class Material : public Unique<nook_material, nook_material_destroy> {
 public:
  Material(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  nook_material_info info() const {
    nook_material_info info{};
    info.struct_size = sizeof info;
    check(nook_material_describe(get(), &info));
    return info;
  }
  void evaluate(const nook_material_sample* samples, std::uint32_t count, nook_material_value* values) const {
    check(nook_material_evaluate(get(), samples, count, values));
  }

 private:
  static nook_material load(const Context& context, const void* bytes, std::size_t size) {
    nook_material handle = nullptr;
    check(nook_material_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

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

#ifdef NOOK_HPP_GL
// The caller sets get_proc.
inline nook_gl_desc gl_desc() {
  nook_gl_desc desc;
  check(nook_gl_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

inline nook_gl_material_desc gl_material_desc() {
  nook_gl_material_desc desc;
  check(nook_gl_material_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// The caller sets max_width and max_height.
inline nook_nnao_desc nnao_desc(nook_nnao_preset preset = NOOK_NNAO_PRESET_DEFAULT) {
  nook_nnao_desc desc;
  check(nook_nnao_desc_init(&desc, sizeof desc, NOOK_VERSION));
  check(nook_nnao_desc_set_preset(&desc, preset));
  return desc;
}

// The caller sets the size, the depth texture, the projection and the radius.
inline nook_nnao_frame_desc nnao_frame_desc() {
  nook_nnao_frame_desc desc;
  check(nook_nnao_frame_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// Returns the texture memory of a pass with this descriptor, in bytes.
inline std::uint64_t nnao_memory(const nook_nnao_desc& desc) {
  std::uint64_t bytes = 0;
  check(nook_nnao_memory(&desc, &bytes));
  return bytes;
}

// Every function and the destructor belong to the context thread, as nook_gl.h documents.
class Gl : public Unique<nook_gl, nook_gl_destroy> {
 public:
  Gl() = default;
  Gl(const Context& context, const nook_gl_desc& desc) : Unique(create(context, desc)) {}

  void context_lost() { check(nook_gl_context_lost(get())); }
  nook_gl_info info() const {
    nook_gl_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_describe(get(), &info));
    return info;
  }
  nook_gl_memory memory_of(const CharacterModel& model) const {
    nook_gl_memory memory{};
    memory.struct_size = sizeof memory;
    check(nook_gl_model_memory(get(), model.get(), &memory));
    return memory;
  }
  void prepare(const Scene& scene) { check(nook_gl_scene_prepare(get(), scene.get())); }
  // Replaces scene.update().
  void update(Scene& scene) { check(nook_gl_scene_update(get(), scene.get())); }
  nook_gl_ao_view ao_buffer(const Scene& scene, nook_instance_id id) const {
    nook_gl_ao_view view{};
    view.struct_size = sizeof view;
    check(nook_gl_scene_ao_buffer(get(), scene.get(), id, &view));
    return view;
  }
  // Copies AO to a buffer or texture of the host on the GPU; struct_size of the target is set here.
  void write_ao(const Scene& scene, const std::vector<nook_instance_id>& ids,
                nook_gl_ao_target target) const {
    target.struct_size = sizeof target;
    check(nook_gl_scene_write_ao(get(), scene.get(), ids.data(), static_cast<std::uint32_t>(ids.size()),
                                 &target));
  }
  // Waits for the GPU.
  void read_ao(const Scene& scene, nook_instance_id id, float* out, std::uint32_t count) const {
    check(nook_gl_scene_read_ao(get(), scene.get(), id, out, count));
  }
  nook_gl_light_view light(const Scene& scene, nook_instance_id id) const {
    nook_gl_light_view view{};
    view.struct_size = sizeof view;
    check(nook_gl_scene_light(get(), scene.get(), id, &view));
    return view;
  }
  // Writes three floats for each vertex; waits for the GPU.
  void read_directional_ao(const Scene& scene, nook_instance_id id, float* out_rgb,
                           std::uint32_t count) const {
    check(nook_gl_scene_read_directional_ao(get(), scene.get(), id, out_rgb, count));
  }
  void release(const Scene& scene) { check(nook_gl_scene_release(get(), scene.get())); }

 private:
  static nook_gl create(const Context& context, const nook_gl_desc& desc) {
    nook_gl handle = nullptr;
    check(nook_gl_create(context.get(), &desc, &handle));
    return handle;
  }
};

// A probe or a grid in a texture of its own. Every function belongs to the context thread, as nook_gl_probe.h
// documents.
class GlProbe : public Unique<nook_gl_probe, nook_gl_probe_destroy> {
 public:
  GlProbe(const Gl& gl, nook_probe probe) : Unique(create(gl, probe)) {}

  void update(nook_probe probe) { check(nook_gl_probe_update(get(), probe)); }
  nook_gl_probe_info info() const {
    nook_gl_probe_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_probe_describe(get(), &info));
    return info;
  }

 private:
  static nook_gl_probe create(const Gl& gl, nook_probe probe) {
    nook_gl_probe handle = nullptr;
    check(nook_gl_probe_create(gl.get(), probe, &handle));
    return handle;
  }
};

// Every function and the destructor belong to the context thread, as for Gl.
class GlMaterial : public Unique<nook_gl_material, nook_gl_material_destroy> {
 public:
  GlMaterial() = default;
  GlMaterial(const Gl& gl, const Material& material, const nook_gl_material_desc& desc = gl_material_desc())
      : Unique(create(gl, material, desc)) {}

  nook_gl_material_info info() const {
    nook_gl_material_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_material_describe(get(), &info));
    return info;
  }
  std::vector<nook_gl_material_texture> textures() const {
    std::vector<nook_gl_material_texture> all(info().texture_count);
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      all[i].struct_size = sizeof all[i];
      check(nook_gl_material_describe_texture(get(), i, &all[i]));
    }
    return all;
  }

 private:
  static nook_gl_material create(const Gl& gl, const Material& material, const nook_gl_material_desc& desc) {
    nook_gl_material handle = nullptr;
    check(nook_gl_material_create(gl.get(), material.get(), &desc, &handle));
    return handle;
  }
};

// Every function and the destructor belong to the context thread, as for Gl.
class GlTransfer : public Unique<nook_gl_transfer, nook_gl_transfer_destroy> {
 public:
  GlTransfer() = default;
  GlTransfer(const Gl& gl, const TransferResponse& response, std::uint32_t vertex_count)
      : Unique(create(gl, response, vertex_count)) {}

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
};

// The stages of a screen-space pass as data, for hosts without OpenGL.
class NnaoStages : public Unique<nook_nnao_stages, nook_nnao_stages_destroy> {
 public:
  NnaoStages() = default;
  NnaoStages(const Context& context, const nook_nnao_desc& desc) : Unique(create(context, desc)) {}

  nook_nnao_stages_info info() const {
    nook_nnao_stages_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_stages_describe(get(), &info));
    return info;
  }
  nook_nnao_stage_info stage(std::uint32_t index) const {
    nook_nnao_stage_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_stages_stage(get(), index, &info));
    return info;
  }
  nook_nnao_image_info image(nook_nnao_image image) const {
    nook_nnao_image_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_stages_image(get(), image, &info));
    return info;
  }
  // earlier: null for a cut.
  nook_nnao_frame_values frame(const nook_nnao_frame_desc& frame,
                               const nook_nnao_frame_desc* earlier = nullptr, std::uint32_t number = 0,
                               std::uint32_t layer = 0) const {
    nook_nnao_frame_values values{};
    values.struct_size = sizeof values;
    check(nook_nnao_stages_frame(get(), &frame, earlier, number, layer, &values));
    return values;
  }

 private:
  static nook_nnao_stages create(const Context& context, const nook_nnao_desc& desc) {
    nook_nnao_stages handle = nullptr;
    check(nook_nnao_stages_create(context.get(), &desc, &handle));
    return handle;
  }
};

// Every function and the destructor belong to the context thread, as nook_nnao.h documents.
class Nnao : public Unique<nook_nnao, nook_nnao_destroy> {
 public:
  Nnao() = default;
  Nnao(const Gl& gl, const nook_nnao_desc& desc) : Unique(create(gl, desc)) {}

  void render(const nook_nnao_frame_desc& frame) { check(nook_nnao_render(get(), &frame)); }
  void recheck() { check(nook_nnao_recheck(get())); }
  Recording record(const nook_nnao_frame_desc& frame, const char* note = nullptr) {
    nook_nnao_recording handle = nullptr;
    check(nook_nnao_record(get(), &frame, note, &handle));
    return Recording(handle);
  }
  nook_nnao_info info() const {
    nook_nnao_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_describe(get(), &info));
    return info;
  }
  nook_nnao_timings timings() const {
    nook_nnao_timings timings{};
    timings.struct_size = sizeof timings;
    check(nook_nnao_read_timings(get(), &timings));
    return timings;
  }

 private:
  static nook_nnao create(const Gl& gl, const nook_nnao_desc& desc) {
    nook_nnao handle = nullptr;
    check(nook_nnao_create(gl.get(), &desc, &handle));
    return handle;
  }
};

#endif

}  // namespace wrapper
}  // namespace nook
#endif
