// The pool of a scene on the CPU: parts are lent and taken back without an allocation, and near instances
// darken the world as in a scene without a pool.
#include "sdk/src/character/scene_pool.h"

#include "sdk/src/character/scene_clips.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/clip_sample.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

// Memory that counts what is held.
class CountingMemory final : public Memory {
 public:
  long long bytes = 0;
  long allocations = 0;

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    bytes += static_cast<long long>(size);
    ++allocations;
    return default_memory()->allocate(size, alignment);
  }
  void do_deallocate(void* at, std::size_t size, std::size_t alignment) override {
    bytes -= static_cast<long long>(size);
    default_memory()->deallocate(at, size, alignment);
  }
};

struct Sample {
  Sample() {
    Numbers numbers(3);
    CharacterModel body = sample_model(31);
    add_world_casters(body, numbers);
    model = load(std::move(body));
    clips = Owned<LoadedClips>::make(default_memory(), Ref<const RefCounted>(),
                                     sample_clips(model->model).set, model, default_memory());
  }
  void play(Scene& scene, nook_instance_id id, float x) const {
    const nook_instance_clip clip{id, 0, {1, NOOK_CLIP_LOOP, 0.3}, {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0}};
    set_clips(scene, clips, {&clip, 1});
  }
  Ref<const LoadedModel> model;
  Ref<const LoadedClips> clips;
};

}  // namespace

TEST_CASE("parts of a pool come and go without an allocation, and cast as those of a scene without one") {
  const Sample sample;
  CountingMemory memory;
  {
    Scene plain = make_scene(), pooled({}, {}, &memory);
    set_pool(pooled, 2, 10, 5);
    std::vector<nook_instance_id> ids;
    for (int i = 0; i < 5; ++i) {
      ids.push_back(add_instance(pooled, sample.model));
      add_instance(plain, sample.model);
    }
    for (int i = 0; i < 5; ++i) {
      sample.play(plain, ids[i], float(i));
      sample.play(pooled, ids[i], float(i));
    }
    reserve_parts(pooled);
    CHECK(pooled.pool.spare.size() == 2);
    const long allocations = memory.allocations;
    for (int i = 0; i < 50; ++i) {
      Instance& near = instance_of(pooled, ids[i % 5]);
      lend_parts(pooled, near);
      REQUIRE(near.parts);
      Instance& same = instance_of(plain, ids[i % 5]);
      pose_world_casters(near);
      pose_world_casters(same);
      CHECK(near.casters().strength == same.casters().strength);
      CHECK(near.casters().bound.radius == same.casters().bound.radius);
      REQUIRE(near.casters().posed.size() == same.casters().posed.size());
      for (std::size_t c = 0; c < near.casters().posed.size(); ++c)
        CHECK(near.casters().posed[c].capsule.a.x == same.casters().posed[c].capsule.a.x);
      if (i % 2) continue;
      return_parts(pooled, near);
      CHECK_FALSE(near.parts);
      if (i > 0) return_parts(pooled, instance_of(pooled, ids[(i - 1) % 5]));
    }
    CHECK(memory.allocations == allocations);
  }
  CHECK(memory.bytes == 0);
}

TEST_CASE("instances of a pool that leave with their parts give them back") {
  const Sample sample;
  Scene scene = make_scene();
  set_pool(scene, 2, 10, 0);
  std::vector<nook_instance_id> ids;
  for (int i = 0; i < 3; ++i) ids.push_back(add_instance(scene, sample.model));
  CHECK_FALSE(was_posed(instance_of(scene, ids[0])));
  CHECK(instance_of(scene, ids[0]).bones().empty());
  CHECK(instance_of(scene, ids[0]).input.bound.radius > 0);
  reserve_parts(scene);
  lend_parts(scene, instance_of(scene, ids[0]));
  lend_parts(scene, instance_of(scene, ids[1]));
  lend_parts(scene, instance_of(scene, ids[2]));
  CHECK_FALSE(instance_of(scene, ids[2]).parts);  // none is left
  remove_instance(scene, ids[0]);
  CHECK(scene.pool.spare.size() == 1);
  // A pose on the CPU needs parts with bones, which stay.
  set_pose(scene, ids[1], stiff_pose(sample.model->model, {1, 2, 3}));
  CHECK(scene.pool.spare.size() == 2);
  CHECK(instance_of(scene, ids[1]).bones()[0].m[3] == 1);
  return_parts(scene, instance_of(scene, ids[1]));
  CHECK(instance_of(scene, ids[1]).parts);
  CHECK_THROWS_AS(set_pool(scene, 3, 10, 0), Failure);
  CHECK_NOTHROW(set_pool(scene, 2, 20, 0));
  CHECK_THROWS_AS(need_no_pool(scene, "of this test"), Failure);
}

TEST_CASE("a far instance is not due, casts nothing and is nobody's neighbour") {
  Scene scene = make_scene();
  const auto model = load(sample_model(31));
  const nook_instance_id near = place(scene, model, {0, 0, 0}), far = place(scene, model, {1, 0, 0}),
                         linked = place(scene, model, {2, 0, 0});
  link(scene, near, linked);
  link_nearest(scene, 2, 100);
  const auto casters = [&] {
    resolve_casters(scene, [](std::uint32_t) { return false; });
    return instance_of(scene, near).plan.casters.size();
  };
  CHECK(casters() == 2);
  instance_of(scene, far).plan.is_far = true;
  CHECK(casters() == 1);
  CHECK_FALSE(instance_of(scene, far).plan.due);
  instance_of(scene, linked).plan.is_far = true;
  CHECK(casters() == 0);
  CHECK(instance_of(scene, near).plan.due);
}
