#include <string>

#include "bakers/tool/inspect/describe.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/scene_readings.h"

namespace nook::tool {
namespace {

constexpr const char* kernel_names[] = {"paper", "nook", "rational"};
static_assert(std::size(kernel_names) == kernel_form_count);

}  // namespace

Row describe_character(std::span<const std::byte> bytes) {
  const CharacterModel model = read_character_model(bytes);
  const Container container(bytes, character_kind);
  Row row;
  row["kind"] = "character model";
  row["format_version"] = container.version();
  row["bytes"] = bytes.size();
  row["vertices"] = model.vertex_count();
  row["file_vertices"] = model.file_to_welded.size();
  row["primitives"] = model.primitives.size();
  row["bones"] = model.bone_count();
  row["spheres"] = model.spheres.size();
  row["key_points"] = model.key_points.size();
  row["world_casters"] = model.world_casters.size();
  row["bent_normals"] = !model.occluded.empty();
  row["influences"] = model.influences;
  row["kernel"] = text_of(kernel_names, std::size_t(model.kernel.form));
  row["gamma"] = model.kernel.gamma;
  row["max_saturation"] = max_saturation_of(model);
  row["bounding_radius_m"] = model.bounding_radius;
  for (const char* name : {"HEAD", "BONE", "SPHR", "KEYP", "LINR", "STAO", "FMAP", "PRIM", "LODS", "BIND",
                           "NEAR", "REST", "WCAS", "BENT", "SATU", "RECP"}) {
    const char letters[5] = {name[0], name[1], name[2], name[3], 0};
    row[std::string("bytes_") + name] = container.has(letters) ? container.section(letters).remaining() : 0;
  }
  add_recipe(row, model.recipe);
  // Measures the host memory of the loaded model and of an instance, like nook_model_describe.
  MeteredMemory memory(default_memory());
  const Ref<LoadedModel> loaded = Owned<LoadedModel>::make(&memory, Ref<const RefCounted>(),
                                                           read_character_model(bytes, &memory), &memory);
  row["memory_model_bytes"] = memory.bytes();
  row["memory_instance_bytes"] = instance_bytes(*loaded);
  row["memory_lit_instance_bytes"] = instance_bytes(*loaded) + light_bytes(*loaded);
  return row;
}

Row describe_clips(std::span<const std::byte> bytes) {
  const ClipSet set = read_clip_set(bytes);
  const Container container(bytes, clip_kind);
  Row row;
  row["kind"] = "clips";
  row["format_version"] = container.version();
  row["bytes"] = bytes.size();
  row["clips"] = set.clips.size();
  row["frames"] = set.frame_count;
  row["vertices"] = set.ao.rows;
  row["bones"] = set.bones.size();
  row["modes"] = set.ao.modes;
  row["pose_modes"] = set.pose.modes;
  row["bytes_per_frame_vertex"] = double(bytes.size()) / (double(set.frame_count) * double(set.ao.rows));
  for (const char* name : {"HEAD", "NAME", "AO  ", "BONE", "POSE", "RECP"}) {
    const char letters[5] = {name[0], name[1], name[2], name[3], 0};
    std::string key = "bytes_";
    for (const char* c = name; *c && *c != ' '; ++c) key += *c;
    row[key] = container.section(letters).remaining();
  }
  Row names = Row::array();
  for (const ClipRange& clip : set.clips) names.push_back(std::string(clip.name));
  row["clip_names"] = std::move(names);
  add_recipe(row, set.recipe);
  return row;
}

}  // namespace nook::tool
