#include <algorithm>
#include <cmath>

#include "sdk/src/character/scene.h"
#include "sdk/src/character/scene_clips.h"

namespace nook {

float caster_strength(const PosedCaster& caster) {
  const Capsule& c = caster.capsule;
  const float radius = caster.ao_scale * std::max(c.radius_a, c.radius_b);
  constexpr float two_over_pi = 0.636619772f;
  return radius * (radius + two_over_pi * length(c.b - c.a));
}

void pose_world_casters(Instance& instance) noexcept {
  InstanceCasters& casters = instance.parts->casters;
  if (casters.posed_revision == instance.input.pose_revision) return;
  casters.posed_revision = instance.input.pose_revision;
  casters.strength = 0;
  casters.bound = {};
  const auto& of_model = instance.model->model.world_casters;
  Vec3 sum;
  for (std::size_t i = 0; i < of_model.size(); ++i) {
    const WorldCaster& caster = of_model[i];
    const Mat3x4 bone = bone_of(instance, caster.bone);
    const float scale = length({bone.m[0], bone.m[4], bone.m[8]});
    PosedCaster& posed = casters.posed[i];
    posed.capsule = {transform_point(bone, caster.capsule.a), transform_point(bone, caster.capsule.b),
                     scale * caster.capsule.radius_a, scale * caster.capsule.radius_b};
    posed.ao_scale = caster.ao_scale;
    casters.strength += caster_strength(posed);
    sum += posed.capsule.a + posed.capsule.b;
  }
  if (of_model.empty()) return;
  casters.bound.centre = sum * (0.5f / static_cast<float>(of_model.size()));
  for (const PosedCaster& posed : casters.posed) {
    const Capsule& c = posed.capsule;
    const float wide = std::max(posed.ao_scale, 1.0f);
    casters.bound.radius =
        std::max({casters.bound.radius, length(c.a - casters.bound.centre) + wide * c.radius_a,
                  length(c.b - casters.bound.centre) + wide * c.radius_b});
  }
}

// Chooses which instances are due in an update, and their levels of detail. Then chooses the casters of each
// due instance: linked instances, the k nearest instances, free occluders and the ground. Skips casters whose
// effect is below cutoff_error.

namespace {

// Returns an upper bound for the AO that a caster takes from a vertex. The caster's spheres have sum(weight *
// radius^2) = strength, and their centres are at least `gap` away from the vertex's key points. A form factor
// is at most (radius / distance)^2. 1 - exp(-x) and 1 - exp(-solid_depth(x)) are at most x, because their
// slopes are 1 at 0 and decrease from there.
float composed_bound(const LoadedModel& receiver, float strength, float gap) {
  return gap > 0 ? receiver.linear.max_blend_gain() * strength / (gap * gap) : INFINITY;
}

// Returns an upper bound for the term of a sphere in the paper's form, at a distance of `delta` radii. The
// bound is the solid angle of slide 18, or the fall-off of the other kernels, at full visibility.
float term_bound(KernelForm form, float delta) {
  switch (form) {
    case KernelForm::paper:
      return 0.75f / (1 + 4 * (delta - 1));
    case KernelForm::rational:
      return 1.5f / (1 + 2 * delta * delta);
    case KernelForm::nook:
      break;
  }
  return 1 / (delta * delta);
}

// Returns an upper bound for the AO that a single sphere takes. A sphere increases the norm by at most its
// term, and AO changes by at most max_alpha_sum times the term.
float paper_bound(const LoadedModel& receiver, float radius, float gap) {
  return gap > radius ? receiver.max_alpha_sum * term_bound(receiver.model.kernel.form, gap / radius)
                      : INFINITY;
}

const Vector<ProxySphere>& spheres_at(const CharacterModel& model, std::uint32_t level) {
  const std::size_t l = std::min<std::size_t>(level, model.levels.size());
  return l == 0 ? model.spheres : model.levels[l - 1].spheres;
}

// Returns an upper bound for the AO that all spheres of a caster take together. By Minkowski's inequality,
// the norm increases by at most the norm of the new terms. The shadow increases by at most as much as the
// norm.
float paper_bound(const LoadedModel& receiver, std::uint32_t receiver_level, const Instance& caster,
                  float gap) {
  const Kernel& kernel = receiver.model.kernel;
  float sum = 0;
  for (const ProxySphere& sphere : spheres_at(caster.model->model, receiver_level)) {
    const float radius = sphere.radius * caster.input.scale;
    if (!(gap > radius)) return INFINITY;
    sum += std::pow(term_bound(kernel.form, gap / radius), kernel.gamma);
  }
  return receiver.max_alpha_sum * std::pow(sum, 1 / kernel.gamma);
}

bool matters(const Scene& scene, const Instance& receiver, const Instance& caster) {
  if (scene.settings.cutoff_error <= 0) return true;
  const float gap = length(caster.input.bound.centre - receiver.input.bound.centre) -
                    caster.input.bound.radius - receiver.input.bound.radius;
  const float bound =
      scene.settings.form == NOOK_FORM_DEFAULT
          ? composed_bound(*receiver.model,
                           caster.model->caster_strength * caster.input.scale * caster.input.scale, gap)
          : paper_bound(*receiver.model, receiver.plan.level, caster, gap);
  return !(bound < scene.settings.cutoff_error);
}

bool matters(const Scene& scene, const Instance& receiver, const Sphere& sphere) {
  if (scene.settings.cutoff_error <= 0) return true;
  const float gap = length(sphere.centre - receiver.input.bound.centre) - receiver.input.bound.radius;
  const float bound = scene.settings.form == NOOK_FORM_DEFAULT
                          ? composed_bound(*receiver.model, sphere.radius * sphere.radius, gap)
                          : paper_bound(*receiver.model, sphere.radius, gap);
  return !(bound < scene.settings.cutoff_error);
}

void gather_casters(const Scene& scene, std::uint32_t slot, Instance& receiver) {
  receiver.plan.casters.clear();
  if (!(scene.terms & NOOK_TERM_LINKS)) return;
  const auto offer = [&](std::uint32_t caster) {
    if (matters(scene, receiver, scene.instances[caster]))
      receiver.plan.casters.push_back(caster);
    else
      ++receiver.plan.culled;
  };
  for (const std::uint32_t caster : receiver.input.linked)
    if (!scene.instances[caster].plan.is_far) offer(caster);
  std::array<Neighbour, max_nearest> found;
  const std::uint32_t count = find_nearest(scene.neighbours, slot, receiver.input.bound.centre, scene.nearest,
                                           scene.nearest_max_distance, found);
  for (std::uint32_t i = 0; i < count; ++i)
    if (!std::binary_search(receiver.input.linked.begin(), receiver.input.linked.end(), found[i].slot))
      offer(found[i].slot);
  // Sorts the casters by slot, so that floating-point sums do not depend on the order in which they were
  // found.
  std::sort(receiver.plan.casters.begin(), receiver.plan.casters.end());
}

void gather_occluders(const Scene& scene, Instance& receiver) {
  receiver.plan.occluders.clear();
  if (!(scene.terms & NOOK_TERM_OCCLUDERS)) return;
  for (std::uint32_t i = 0; i < scene.occluders.size(); ++i) {
    const Occluder& occluder = scene.occluders[i];
    if (occluder.id == 0 || (occluder.receiver && occluder.receiver != receiver.id)) continue;
    if (matters(scene, receiver, occluder.sphere))
      receiver.plan.occluders.push_back(i);
    else
      ++receiver.plan.culled;
  }
}

// A bone without geometry may have any scale. So the radius is limited by the size of the posed body.
float ground_radius(const Scene& scene, const Instance& receiver) {
  if (scene.settings.ground_radius > 0) return scene.settings.ground_radius;
  const float in_rest = receiver.model->model.bounding_radius * receiver.input.largest_scale();
  const float posed = receiver.input.bound.radius;
  return default_ground_radii * (in_rest > 0 ? std::min(in_rest, 2 * posed) : posed);
}

// Places the ground's sphere below the plane, so that it touches the plane at the projection of the bound's
// centre.
void place_ground(const Scene& scene, Instance& receiver) {
  receiver.plan.ground_sphere = {};
  if (!receiver.input.has_ground || !(scene.terms & NOOK_TERM_GROUND)) return;
  const Plane& plane = receiver.input.ground;
  const float height = dot(plane.normal, receiver.input.bound.centre) - plane.offset;
  const float radius = ground_radius(scene, receiver);
  const Sphere ground{receiver.input.bound.centre - plane.normal * (height + radius), radius};
  if (matters(scene, receiver, ground))
    receiver.plan.ground_sphere = ground;
  else
    ++receiver.plan.culled;
}

// Decides whether the instance is due, and chooses its level. Distant instances take turns: each is evaluated
// at least once every lod_max_interval frames. An instance uses the coarsest level whose error is acceptable
// at its distance.
void choose_detail(const Scene& scene, std::uint32_t slot, bool has_result, Instance& instance) {
  instance.plan.level = 0;
  instance.plan.due = !instance.plan.is_far;
  if (instance.plan.is_far || !scene.has_camera) return;
  const SceneSettings& settings = scene.settings;
  const float distance = length(instance.input.bound.centre - scene.camera) / settings.lod_distance;
  const auto& levels = instance.model->model.levels;
  for (std::uint32_t level = 0; level < levels.size(); ++level)
    if (levels[level].error_rms < settings.lod_error * distance) instance.plan.level = level + 1;
  const float most = static_cast<float>(settings.lod_max_interval);
  const auto interval = static_cast<std::uint32_t>(std::min(std::max(distance, 1.0f), most));
  instance.plan.due = !has_result || (scene.frame + slot) % interval == 0;
}

}  // namespace

void resolve_casters(Scene& scene, HasResult has_result) noexcept {
  if (scene.nearest > 0) {
    clear_tree(scene.neighbours);
    for (std::uint32_t slot = 0; slot < scene.instances.size(); ++slot)
      if (scene.instances[slot].id && !scene.instances[slot].plan.is_far)
        add_to_tree(scene.neighbours, slot, scene.instances[slot].input.bound.centre);
    build_tree(scene.neighbours);
  }
  auto resolve = [&](std::uint32_t slot) noexcept {
    Instance& instance = scene.instances[slot];
    if (instance.id == 0) return;
    choose_detail(scene, slot, has_result(slot), instance);
    if (!instance.plan.due) return;
    instance.plan.culled = 0;
    instance.plan.frame = scene.frame;
    gather_casters(scene, slot, instance);
    gather_occluders(scene, instance);
    place_ground(scene, instance);
  };
  parallel_for(scene.parallel, static_cast<std::uint32_t>(scene.instances.size()), resolve);
}

}  // namespace nook
