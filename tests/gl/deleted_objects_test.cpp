// Objects that a call deletes while the host has them bound: OpenGL unbinds them, without an error and
// without making their names anew, as it would if the host had deleted them itself.
#include <functional>
#include <optional>
#include <set>

#include "tests/gl/nnao_images.h"
#include "tests/gl/probe_capture_scene.h"
#include "tests/gl/test_context.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

namespace {

enum Kind {
  buffers,
  textures,
  samplers,
  framebuffers,
  renderbuffers,
  vertex_arrays,
  feedbacks,
  programs,
  kinds
};
constexpr const char* kind_names[] = {
    "buffer", "texture", "sampler", "framebuffer", "renderbuffer", "vertex array", "transform feedback",
    "program"};

bool is_program(const GladGLContext& gl, GLuint name) {
  // A program that is current lives on as a deleted one.
  GLint deleted = GL_FALSE;
  if (gl.IsProgram(name)) gl.GetProgramiv(name, GL_DELETE_STATUS, &deleted);
  return gl.IsProgram(name) && !deleted;
}

bool lives(const GladGLContext& gl, int kind, GLuint name) {
  switch (kind) {
    case buffers:
      return gl.IsBuffer(name);
    case textures:
      return gl.IsTexture(name);
    case samplers:
      return gl.IsSampler(name);
    case framebuffers:
      return gl.IsFramebuffer(name);
    case renderbuffers:
      return gl.IsRenderbuffer(name);
    case vertex_arrays:
      return gl.IsVertexArray(name);
    case feedbacks:
      return gl.IsTransformFeedback && gl.IsTransformFeedback(name);
    default:
      return is_program(gl, name);
  }
}

// Names are handed out from 1 on, on every driver that the tests run on, and some drivers never use one
// again. The cases here use up tens of thousands, so that CMakeLists.txt has them run after all others.
constexpr GLuint most_names = 1 << 16;

std::set<GLuint> living(const GladGLContext& gl, int kind) {
  std::set<GLuint> found;
  for (GLuint name = 1; name < most_names; ++name)
    if (lives(gl, kind, name)) found.insert(name);
  return found;
}

// A place where a host binds objects of a kind.
struct Place {
  std::string name;
  std::function<void(GLuint)> bind;
  std::function<GLint()> bound;
};

GLint integer(const GladGLContext& gl, GLenum name) {
  GLint value = -1;
  gl.GetIntegerv(name, &value);
  return value;
}

// The host's own objects, by which Nook's are bound indirectly.
struct Host {
  explicit Host(platform::Context& context)
      : gl(context.gl()), version(version_of(context)), es(is_es(context.gl())) {
    gl.GenVertexArrays(1, &array);
    gl.GenFramebuffers(1, &framebuffer);
  }
  ~Host() {
    gl.BindVertexArray(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteVertexArrays(1, &array);
    gl.DeleteFramebuffers(1, &framebuffer);
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  bool storage() const { return version >= (es ? 31 : 43); }

  Place place(const char* name, GLenum binding, std::function<void(GLuint)> bind) const {
    return {name, std::move(bind), [this, binding] { return integer(gl, binding); }};
  }
  Place buffer_place(const char* name, GLenum target, GLenum binding) const {
    return place(name, binding, [this, target](GLuint object) { gl.BindBuffer(target, object); });
  }
  Place indexed_place(const char* name, GLenum target, GLenum binding, GLuint index) const {
    return {name, [=, this](GLuint object) { gl.BindBufferBase(target, index, object); },
            [=, this] {
              GLint value = -1;
              gl.GetIntegeri_v(binding, index, &value);
              return value;
            }};
  }
  std::vector<Place> buffer_places() const {
    // First those that also bind a target: a range binds the target of its kind, an attribute reads "array".
    std::vector<Place> all = {indexed_place("transform feedback 0", GL_TRANSFORM_FEEDBACK_BUFFER,
                                            GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, 0),
                              {"attribute of the host's vertex array",
                               [this](GLuint object) {
                                 gl.BindVertexArray(array);
                                 gl.BindBuffer(GL_ARRAY_BUFFER, object);
                                 gl.VertexAttribPointer(1, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
                                 gl.BindBuffer(GL_ARRAY_BUFFER, 0);
                               },
                               [this] {
                                 gl.BindVertexArray(array);
                                 GLint value = -1;
                                 gl.GetVertexAttribiv(1, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &value);
                                 return value;
                               }},
                              {"index of the host's vertex array",
                               [this](GLuint object) {
                                 gl.BindVertexArray(array);
                                 gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, object);
                               },
                               [this] {
                                 gl.BindVertexArray(array);
                                 return integer(gl, GL_ELEMENT_ARRAY_BUFFER_BINDING);
                               }},
                              buffer_place("array", GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING),
                              buffer_place("unpack", GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING),
                              buffer_place("pack", GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING),
                              buffer_place("uniform", GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING)};
    if (storage())
      for (GLuint i = 0; i < 4; ++i)
        all.push_back(indexed_place("storage of an index", GL_SHADER_STORAGE_BUFFER,
                                    GL_SHADER_STORAGE_BUFFER_BINDING, i));
    return all;
  }
  // A texture can be bound to the target of its kind alone. Slot 0 is an attachment where the kind can be
  // one.
  std::optional<Place> texture_place(GLuint name, GLuint slot) const {
    const std::pair<GLenum, GLenum> targets[] = {{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                                                 {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                                                 {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
                                                 {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER}};
    gl.ActiveTexture(GL_TEXTURE0 + slot);
    for (const auto& [target, binding] : targets) {
      if (es && target == GL_TEXTURE_BUFFER && version < 32) continue;
      gl.BindTexture(target, name);
      if (gl.GetError() != GL_NO_ERROR) continue;
      gl.BindTexture(target, 0);
      take_debug_messages();
      if (target == GL_TEXTURE_2D && slot == 0) return attachment();
      return Place{"unit " + std::to_string(slot),
                   [=, this, target = target](GLuint object) {
                     gl.ActiveTexture(GL_TEXTURE0 + slot);
                     gl.BindTexture(target, object);
                   },
                   [=, this, binding = binding] {
                     gl.ActiveTexture(GL_TEXTURE0 + slot);
                     return integer(gl, binding);
                   }};
    }
    take_debug_messages();
    return {};
  }
  Place attachment() const {
    return {"attachment of the host's framebuffer",
            [this](GLuint object) {
              gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
              gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, object, 0);
            },
            [this] {
              gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
              GLint value = -1;
              gl.GetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                                     GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &value);
              return value;
            }};
  }
  // How many objects of a kind can be bound at once, each to a place of its own.
  std::size_t slots(int kind) const {
    switch (kind) {
      case buffers:
        return buffer_places().size();
      case textures:
      case samplers:
        return 5;
      case framebuffers:
        return 2;
      default:
        return 1;
    }
  }
  std::optional<Place> place_of(int kind, GLuint name, std::size_t slot) const {
    switch (kind) {
      case buffers:
        return buffer_places()[slot];
      case textures:
        return texture_place(name, GLuint(slot));
      case samplers:
        return Place{"unit " + std::to_string(slot),
                     [=, this](GLuint object) { gl.BindSampler(GLuint(slot), object); },
                     [=, this] {
                       gl.ActiveTexture(GL_TEXTURE0 + GLuint(slot));
                       return integer(gl, GL_SAMPLER_BINDING);
                     }};
      case framebuffers:
        return slot == 0 ? place("draw", GL_DRAW_FRAMEBUFFER_BINDING,
                                 [this](GLuint object) { gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, object); })
                         : place("read", GL_READ_FRAMEBUFFER_BINDING,
                                 [this](GLuint object) { gl.BindFramebuffer(GL_READ_FRAMEBUFFER, object); });
      case renderbuffers:
        return place("renderbuffer", GL_RENDERBUFFER_BINDING,
                     [this](GLuint object) { gl.BindRenderbuffer(GL_RENDERBUFFER, object); });
      case vertex_arrays:
        return place("vertex array", GL_VERTEX_ARRAY_BINDING,
                     [this](GLuint object) { gl.BindVertexArray(object); });
      case feedbacks:
        return place("transform feedback", GL_TRANSFORM_FEEDBACK_BINDING,
                     [this](GLuint object) { gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, object); });
      default:
        return place("program", GL_CURRENT_PROGRAM, [this](GLuint object) { gl.UseProgram(object); });
    }
  }

  const GladGLContext& gl;
  int version;
  bool es;
  GLuint array = 0, framebuffer = 0;
};

using Step = std::function<void()>;
// Makes everything anew, calls the step before, the call, and the step after, and puts everything away.
struct Scenario {
  std::string name;
  std::function<void(const Step& before, const Step& after)> run;
};

// Kinds whose places are apart, so that objects of all of them can be bound at once. Binding to the places
// of the second list changes bindings of the first one.
const std::vector<int> apart[] = {{buffers, textures, samplers, renderbuffers, programs},
                                  {framebuffers, vertex_arrays, feedbacks}};

struct BoundObject {
  int kind;
  GLuint name;
  Place place;
  GLint bound = -1;
};

struct Round {
  std::vector<BoundObject> bound;
  int gone = 0;
  bool last = true;  // no kind has objects for another round
};

// Binds the index-th objects of a kind that the scenario has made, as many as the kind has places. `outside`:
// objects that are there without the scenario.
void bind_round(const Host& host, int kind, std::size_t index, const std::set<GLuint>& outside,
                Round& round) {
  std::vector<GLuint> made;
  for (const GLuint candidate : living(host.gl, kind))
    if (!outside.count(candidate)) made.push_back(candidate);
  std::vector<BoundObject> bound;
  const std::size_t slots = host.slots(kind);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    // Rounds begin at another place each, so that few objects do not all meet the first ones.
    const std::size_t i = index * slots + (slot + index) % slots;
    if (i >= made.size()) continue;
    if (const std::optional<Place> place = host.place_of(kind, made[i], slot))
      bound.push_back({kind, made[i], *place});
  }
  for (const BoundObject& object : bound) object.place.bind(object.name);
  for (BoundObject& object : bound) object.bound = object.place.bound();
  round.bound.insert(round.bound.end(), bound.begin(), bound.end());
  round.last = round.last && made.size() <= (index + 1) * slots;
}

// Returns whether the object is gone. preserves: the call puts the host's bindings back before it deletes.
// Otherwise what is bound while it deletes is its own affair, and only errors are looked for.
bool check_bound(const Host& host, const BoundObject& object, bool preserves) {
  const bool gone = !lives(host.gl, object.kind, object.name);
  INFO(kind_names[object.kind] << " " << object.name << (gone ? ", gone, " : ", lives, ")
                               << object.place.name);
  // OpenGL keeps a deleted program as long as it is current.
  const bool unbound = gone && object.kind != programs;
  if (preserves) CHECK(object.place.bound() == (unbound ? 0 : object.bound));
  return gone;
}

Round check_round(const Host& host, const Scenario& scenario, const std::vector<int>& together,
                  std::size_t index, const std::set<GLuint> (&outside)[kinds], bool preserves) {
  Round round;
  const Step before = [&] {
    for (const int kind : together) bind_round(host, kind, index, outside[kind], round);
    REQUIRE(host.gl.GetError() == GL_NO_ERROR);
  };
  const Step after = [&] {
    INFO(scenario.name);
    CHECK(host.gl.GetError() == GL_NO_ERROR);
    for (const BoundObject& object : round.bound) round.gone += check_bound(host, object, preserves);
    for (const BoundObject& object : round.bound) object.place.bind(0);
    REQUIRE(host.gl.GetError() == GL_NO_ERROR);
  };
  scenario.run(before, after);
  return round;
}

// Returns how many objects the call of the scenario deletes.
int check_scenario(platform::Context& context, const Scenario& scenario, bool preserves = true) {
  const Host host(context);
  int gone = 0;
  std::set<GLuint> outside[kinds];
  for (int kind = 0; kind < kinds; ++kind) outside[kind] = living(host.gl, kind);
  for (const std::vector<int>& together : apart) {
    bool last = false;
    for (std::size_t index = 0; !last; ++index) {
      const Round round = check_round(host, scenario, together, index, outside, preserves);
      gone += round.gone;
      last = round.last;
    }
  }
  GLuint newest = 0;
  host.gl.GenBuffers(1, &newest);
  host.gl.DeleteBuffers(1, &newest);
  CHECK(newest < most_names);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
  return gone;
}

// Two crowds of one nook_gl, lit, so that every buffer and texture of a scene is there.
struct Stage {
  Stage(platform::Context& context, int tier, nook_gl_state_mode mode, int debug) {
    nook_gl_desc desc;
    NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
    desc.get_proc = platform::Context::loader;
    desc.get_proc_user = &context;
    desc.max_tier = tier;
    desc.state_mode = mode;
    desc.debug = debug;
    NOOK_OK_OR_FAIL(nook_gl_create(host.handle, &desc, &gl));
    for (auto& crowd : crowds) {
      crowd = std::make_unique<Crowd>(host.handle, std::vector{model}, std::vector<std::uint32_t>{5},
                                      CrowdOptions{});
      const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
      for (const nook_instance_id id : crowd->ids)
        NOOK_OK_OR_FAIL(nook_scene_set_light(crowd->scene, id, &lobe, 1));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd->scene));
    }
  }
  ~Stage() {
    nook_gl_destroy(&gl);
    for (auto& crowd : crowds) crowd.reset();
    nook_model_destroy(&model);
    nook_model_destroy(&other);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Every character gets a larger model of as many bones.
  void exchange() {
    for (const nook_instance_id id : crowds[0]->ids)
      NOOK_OK_OR_FAIL(nook_scene_set_model(crowds[0]->scene, id, other));
    crowds[0]->pose(1);
  }

  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(21)),
             other = load_model(host.handle, sample_model(22, {5, 30, 60, 300, 60, 7}));
  std::unique_ptr<Crowd> crowds[2];
  nook_gl gl = nullptr;
};

void update(Stage& stage, int crowd = 0) {
  NOOK_OK_OR_FAIL(nook_gl_scene_update(stage.gl, stage.crowds[crowd]->scene));
}

// The calls of scenes that delete objects, or may. `prepare` runs before anything is bound.
struct SceneCall {
  const char* name;
  void (*prepare)(Stage&);
  void (*call)(Stage&);
  bool may_keep = false;  // on tiers whose buffers grow under their names
};
const SceneCall scene_calls[] = {
    {"update after set_model", [](Stage& s) { s.exchange(); }, [](Stage& s) { update(s); }},
    {"prepare after set_model", [](Stage& s) { s.exchange(); },
     [](Stage& s) { NOOK_OK_OR_FAIL(nook_gl_scene_prepare(s.gl, s.crowds[0]->scene)); }},
    {"update of a larger scene",
     [](Stage& s) {
       for (int i = 0; i < 40; ++i) s.crowds[0]->add(s.crowds[0]->ids.size());
     },
     [](Stage& s) { update(s); }, true},
    {"update after a scene was destroyed", [](Stage& s) { s.crowds[0].reset(); },
     [](Stage& s) { update(s, 1); }},
    {"release", [](Stage&) {},
     [](Stage& s) { NOOK_OK_OR_FAIL(nook_gl_scene_release(s.gl, s.crowds[0]->scene)); }},
    {"destroy", [](Stage&) {}, [](Stage& s) { nook_gl_destroy(&s.gl); }}};

Scenario scene_scenario(platform::Context& context, int tier, nook_gl_state_mode mode, int debug,
                        const SceneCall& call) {
  const std::string name = std::string(call.name) + ", tier " + std::to_string(tier) + ", mode " +
                           std::to_string(mode) + ", debug " + std::to_string(debug);
  return {name, [=, &context, &call](const Step& before, const Step& after) {
            Stage stage(context, tier, mode, debug);
            call.prepare(stage);
            before();
            call.call(stage);
            after();
          }};
}

}  // namespace

TEST_CASE("what the calls of scenes delete is unbound by OpenGL") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context))
    for (const SceneCall& call : scene_calls) {
      INFO(call.name << ", tier " << tier);
      const int gone =
          check_scenario(context, scene_scenario(context, tier, NOOK_GL_STATE_PRESERVE, 0, call));
      CHECK((gone > 0 || call.may_keep));
    }
}

TEST_CASE("what an exchange of models deletes is unbound in every mode, also with debug") {
  NOOK_NEED_CONTEXT(context);
  const int tier = tiers_of(context)[0];
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST})
    CHECK(check_scenario(context, scene_scenario(context, tier, mode, 1, scene_calls[0]),
                         mode == NOOK_GL_STATE_PRESERVE) > 0);
}

TEST_CASE("what passes, uploads and captures delete is unbound by OpenGL") {
  NOOK_NEED_CONTEXT(context);
  const Camera camera = plain_camera(1.5f);
  const Picture picture = look(camera, still_life(), world::width, world::height);
  const world::View view;
  const std::vector<nook_capsule> many(4000, world::props(view)[1]);
  const auto with_world = [&](const Step& before, const Step& after, bool destroy) {
    world::WorldFixture fixture(context);
    DarkenedFrame frame = world::world_frame(
        frame_desc(camera, world::width, world::height, fixture.depth_of(camera, picture), 0, 0.5f), view);
    frame.capsules = many.data();
    frame.capsule_count = 3;
    NOOK_OK_OR_FAIL(nook_world_render(fixture.made(), &frame, &frame));
    frame.capsule_count = std::uint32_t(many.size());
    before();
    if (destroy)
      nook_world_destroy(&fixture.pass);
    else
      NOOK_OK_OR_FAIL(nook_world_render(fixture.pass, &frame, &frame));
    after();
  };
  const auto with_uploads = [&](const Step& before, const Step& after) {
    Fixture fixture(context);
    const Probes black = black_grid(probe::vogel_basis(12), {2, 2, 2});
    GlProbe lobes = fixture.upload(black);
    Grid grid = fixture.upload_grid(black, NOOK_GL_PROBE_SH);
    nook_gl_capture_desc desc = default_desc();
    desc.probe = lobes.get();
    desc.face_size_px = 8;
    Capture capture = fixture.capture(desc);
    add(capture, 0, fixture.cubes.make(uneven_cube(8, 3)));
    before();
    capture.reset();
    grid.reset();
    lobes.reset();
    after();
  };
  const Scenario scenarios[] = {
      {"nook_nnao_destroy",
       [&](const Step& before, const Step& after) {
         NnaoFixture fixture(context);
         nook_nnao pass = create_pass(fixture.gl, pass_desc(world::width, world::height));
         ScreenFrame frame =
             frame_desc(camera, world::width, world::height, fixture.depth_of(camera, picture), 0, 0.5f);
         NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
         before();
         nook_nnao_destroy(&pass);
         after();
       }},
      {"nook_world_destroy", [&](const Step& b, const Step& a) { with_world(b, a, true); }},
      {"nook_gl_upload_destroy and nook_gl_capture_destroy", with_uploads}};
  for (const Scenario& scenario : scenarios) CHECK(check_scenario(context, scenario) > 0);
  // It may write into the table that it has.
  check_scenario(context, {"nook_world_render of more casters",
                           [&](const Step& b, const Step& a) { with_world(b, a, false); }});
}
