// The table of a pool on the GPU agrees with the views that the host can ask for.
#include <array>
#include <cstddef>

#include "platform/file_bytes.h"
#include "tests/gl/poison.h"
#include "tests/gl/pooled_crowd.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

using Entry = std::array<std::uint32_t, 4>;  // buffer, first, generation, level

struct Table {
  nook_gl_pool_table info{};
  std::vector<std::uint32_t> ao_buffers;
};

Table table_of(const PooledCrowd& crowd) {
  Table table;
  table.info.struct_size = sizeof table.info;
  table.ao_buffers.resize(8);
  NOOK_OK_OR_FAIL(nook_gl_scene_read_pool_table(crowd.stage.gl, crowd.scene, crowd.stage.model, &table.info,
                                                table.ao_buffers.data(), 8));
  REQUIRE(table.info.ao_buffer_count <= 8);
  table.ao_buffers.resize(table.info.ao_buffer_count);
  return table;
}

template <class Number>
std::vector<Number> contents(platform::Context& context, GLuint buffer, std::size_t offset,
                             std::size_t count) {
  const GladGLContext& gl = context.gl();
  std::vector<Number> out(count);
  gl.BindBuffer(GL_COPY_READ_BUFFER, buffer);
  const auto size = static_cast<GLsizeiptr>(count * sizeof(Number));
  const void* const memory =
      gl.MapBufferRange(GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset), size, GL_MAP_READ_BIT);
  REQUIRE(memory);
  std::copy_n(static_cast<const Number*>(memory), count, out.begin());
  gl.UnmapBuffer(GL_COPY_READ_BUFFER);
  gl.BindBuffer(GL_COPY_READ_BUFFER, 0);
  return out;
}

std::size_t index_of(nook_instance_id id) {
  return (id & 0xfffffu) - 1;
}

// Compares every entry with the view, and what it points to with the AO that Nook reads. Returns a bit for
// each level of a near instance.
std::uint32_t check_table(platform::Context& context, const PooledCrowd& crowd, const Table& table) {
  const auto entries = contents<Entry>(context, table.info.buffer, 0, table.info.entry_count);
  const auto views = crowd.views();
  std::uint32_t levels = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    CAPTURE(i, views[i].is_near);
    REQUIRE(index_of(crowd.ids[i]) < entries.size());
    const Entry& entry = entries[index_of(crowd.ids[i])];
    CHECK(entry[2] == views[i].generation);
    if (!views[i].is_near) {
      CHECK(entry == Entry{0, 0, views[i].generation, 0});
      continue;
    }
    nook_scene_instance_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_scene_describe_instance(crowd.scene, crowd.ids[i], &info));
    CHECK(entry[0] == views[i].buffer);
    CHECK(entry[1] * sizeof(float) == views[i].offset);
    CHECK(entry[3] == info.level);
    CHECK(std::count(table.ao_buffers.begin(), table.ao_buffers.end(), entry[0]) == 1);
    CHECK(contents<float>(context, entry[0], entry[1] * sizeof(float), views[i].count) == crowd.ao(i));
    levels |= 1u << entry[3];
  }
  return levels;
}

}  // namespace

TEST_CASE("the table of a pool agrees with the views while instances come and go") {
  NOOK_NEED_COMPUTE(context);
  const std::vector<unsigned char> file = platform::read_file(NOOK_MANNEQUIN);
  const CharacterModel body =
      read_character_model({reinterpret_cast<const std::byte*>(file.data()), file.size()});
  const Stage stage(context, NOOK_GL_STATE_PRESERVE, platform::Context::loader, nullptr, body);
  PoolOptions options;
  options.places = 5;
  options.distance = 60;
  options.lod_error = 1e-2f;
  PooledCrowd crowd(stage, 12, options);
  // Before the first update, all are far.
  Table table = table_of(crowd);
  check_table(context, crowd, table);
  std::uint32_t levels = 0;
  const auto play = [&](std::size_t frame) {
    std::vector<float> x = two_groups(crowd.ids.size(), frame);
    // Some of the near ones are so far away that they have a coarser level.
    for (std::size_t i = 0; i < x.size(); i += 3)
      if (x[i] < 100) x[i] += 45;
    crowd.play(x, 0.1 * double(frame));
    crowd.update();
    levels |= check_table(context, crowd, table);
  };
  for (std::size_t frame = 0; frame < 6; ++frame) play(frame);
  CHECK(crowd.info().near_count == 5);
  CHECK(levels != 0);
  CHECK((levels & (levels - 1)) != 0);
  // An instance that is removed leaves an empty entry, and the next one has its index.
  const std::size_t near = crowd.near()[0], index = index_of(crowd.ids[near]);
  NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, crowd.ids[near]));
  crowd.ids.erase(crowd.ids.begin() + static_cast<std::ptrdiff_t>(near));
  table = table_of(crowd);
  CHECK(contents<Entry>(context, table.info.buffer, 0, table.info.entry_count)[index] == Entry{});
  play(7);
  // More instances than the buffer has room for.
  const std::uint32_t before = table.info.entry_count;
  while (crowd.ids.size() <= before) crowd.add();
  NOOK_OK_OR_FAIL(nook_gl_scene_prepare(stage.gl, crowd.scene));
  table = table_of(crowd);
  CHECK(table.info.entry_count > before);
  for (std::size_t frame = 0; frame < 3; ++frame) play(frame);
  NOOK_OK_OR_FAIL(nook_gl_scene_release(stage.gl, crowd.scene));
  crowd.update();
  table = table_of(crowd);
  play(3);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("the table of a pool costs no allocation, wait or query in a frame, and only what changes") {
  NOOK_NEED_COMPUTE(context);
  Trace trace(context);
  const Stage stage(context, NOOK_GL_STATE_DEFAULTS, Trace::loader, &trace);
  const PooledCrowd crowd(stage, 16, {5, 10, 3, 16});
  crowd.play(two_groups(16), 0);
  crowd.update();
  crowd.update();
  const auto writes_of_update = [&] {
    trace.reset();
    crowd.update();
    CHECK(trace.forbidden_in_frame(false) == std::set<std::string>());
    return trace.calls("glBufferSubData");
  };
  const int without = writes_of_update();
  const std::uint64_t bytes = info_of(stage.gl).buffer_bytes;
  const Table table = table_of(crowd);
  CHECK(table.info.entry_count == 16);
  CHECK(info_of(stage.gl).buffer_bytes == bytes + 16 * sizeof(Entry));
  const long allocations = stage.host.allocations;
  CHECK(writes_of_update() == without);
  for (std::size_t frame = 1; frame < 5; ++frame) {
    crowd.play(two_groups(16, frame), 0.1 * double(frame));
    CHECK(writes_of_update() > without);
    CHECK(writes_of_update() == without);
    const long now = stage.host.allocations;
    check_table(context, crowd, table);
    CHECK(stage.host.allocations == now);
  }
  CHECK(stage.host.allocations == allocations);
  // A scene with a pool alone has a table.
  const PooledCrowd plain(stage, 1, {});
  nook_gl_pool_table info{};
  info.struct_size = sizeof info;
  CHECK(nook_gl_scene_read_pool_table(stage.gl, plain.scene, stage.model, &info, nullptr, 0) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(says("has no pool"));
}

TEST_CASE("the table of a pool keeps the state contract and survives refused memory") {
  NOOK_NEED_COMPUTE(context);
  const unsigned users = users_of_tier(tiers_of(context).front());
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS}) {
    INFO("mode " << mode);
    const Stage stage(context, mode);
    const PooledCrowd crowd(stage, 8, {4});
    for (std::size_t step = 0; step < 3; ++step) {
      Poison poison(context, users);
      if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
      const StateValues touched = poison.touched(), untouched = poison.untouched();
      table_of(crowd);
      crowd.play(two_groups(8, step), 0.1 * double(step));
      crowd.update();
      CHECK(poison.touched() == (mode == NOOK_GL_STATE_DEFAULTS ? poison.defaults() : touched));
      CHECK(poison.untouched() == untouched);
    }
    auto& host = const_cast<CountedContext&>(stage.host);
    int refusals = 0;
    for (long n = 0;; ++n) {
      PooledCrowd other(stage, 8, {4});
      nook_gl_pool_table info{};
      info.struct_size = sizeof info;
      host.refuse_after = n;
      const nook_result result =
          nook_gl_scene_read_pool_table(stage.gl, other.scene, stage.model, &info, nullptr, 0);
      host.refuse_after = -1;
      other.play(two_groups(8), 0.2);
      other.update();
      check_table(context, other, table_of(other));
      if (result == NOOK_OK) break;
      CHECK(result == NOOK_ERROR_OUT_OF_MEMORY);
      ++refusals;
    }
    CHECK(refusals > 5);
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
}
