// The C functions of nook_world.h.
#include <nook/nook_world.h>

#include <cmath>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/api/world_casting.h"
#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/world/sample.h"

using namespace nook;

static_assert(NOOK_WORLD_MAX_CASTERS == CharacterModel::max_world_casters);
static_assert(NOOK_WORLD_CONE_PARTS == world::cone_parts);

namespace {

world::SampleRequest request_of(const nook_world_sample_desc& desc, float cutoff_error) {
  if (desc.point_count > 0) {
    need(desc.positions, "desc.positions");
    need(desc.normals, "desc.normals");
  }
  check_fits("desc.stride", desc.stride,
             desc.stride % sizeof(float) == 0 && (desc.stride == 0 || desc.stride >= 3 * sizeof(float)),
             "0, or a multiple of 4 that is at least 12");
  checked_stride("desc.stride", desc.stride, desc.point_count, 3 * sizeof(float));
  api::check_props("desc", desc.capsules, desc.capsule_count);
  world::SampleRequest request;
  request.positions = desc.positions;
  request.normals = desc.normals;
  request.count = desc.point_count;
  if (desc.stride) request.stride = desc.stride / sizeof(float);
  request.cutoff_error = cutoff_error;
  if (desc.light_degrees == 0) return request;
  request.has_light = true;
  request.light_axis = api::checked_light("desc", desc.light_axis, desc.light_degrees);
  request.light_half_angle_radians = api::half_angle_radians(desc.light_degrees);
  return request;
}

}  // namespace

nook_result nook_model_read_capsules(nook_model model, nook_model_capsule* out, uint32_t* count) {
  return api::enter("nook_model_read_capsules", [&] {
    need(model, "model");
    need(count, "count");
    const auto& casters = model->model.world_casters;
    const std::uint32_t room = *count, own = static_cast<std::uint32_t>(casters.size());
    *count = own;
    if (own == 0)
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "the model was baked without world casters; bake the character again");
    if (!out) return;
    if (room < own)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "*count is too small (got %u, need %u)", room, own);
    for (const WorldCaster& caster : casters) {
      const Capsule& c = caster.capsule;
      *out++ = {{{c.a.x, c.a.y, c.a.z}, c.radius_a, {c.b.x, c.b.y, c.b.z}, c.radius_b},
                caster.bone,
                caster.ao_scale};
    }
  });
}

nook_result nook_world_sample(nook_scene scene, const nook_world_sample_desc* desc, float* ao, float* light) {
  return api::enter("nook_world_sample", [&] {
    const nook_world_sample_desc given = read_descriptor(desc);
    if (light && given.light_degrees == 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "light is not NULL, but desc.light_degrees is 0; set it to the angle from one edge of "
                    "the light to the other");
    world::SampleRequest request = request_of(given, scene ? scene->scene.settings.cutoff_error : 0);
    world::LightTerms terms;
    if (given.directional_ao) {
      terms = api::terms_of_lobes("desc", given.lobes, given.lobe_count);
      request.terms = &terms;
    }
    if (given.receiver) {
      if (!scene)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "desc.receiver is set, but scene is NULL; pass the scene of the receiver");
      instance_of(scene->scene, given.receiver);
    }
    if (scene) need_cpu_poses(scene->scene);
    const api::Casting casting(scene ? &scene->scene : nullptr, given.receiver, given.capsules,
                               given.capsule_count);
    const Isa isa = scene ? scene->scene.kernels->isa : choose_isa(NOOK_ISA_AUTO);
    world::sample(*world::world_kernels(isa), scene ? scene->scene.parallel : Parallel{}, request,
                  {casting.group_count(), &casting, api::Casting::group}, ao, light, given.directional_ao);
  });
}
