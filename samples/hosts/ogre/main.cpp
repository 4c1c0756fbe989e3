// OGRE draws a character with its own classes and skeleton, and with Nook's ambient occlusion.
//
//   nook_host_ogre CHARACTER.glb MODEL.nook --out PICTURE.png
//
// nook_ogre.cpp is all that an OGRE program needs.
#include <glm/gtc/quaternion.hpp>

#include "platform/file_bytes.h"
#include "samples/hosts/host.h"
#include "samples/hosts/ogre/nook_ogre.h"

namespace {

const char* const vertex_glsl = R"(#version 330 core
in vec4 vertex;
in vec3 normal;
in vec4 colour;
in float uv0;
uniform mat4 clip_from_model, view_from_model;
out vec3 surface_normal_ws, surface_albedo;
out float surface_ao, surface_depth;
void main() {
  surface_normal_ws = normal;
  surface_albedo = colour.rgb;
  surface_ao = uv0;
  surface_depth = -(view_from_model * vertex).z;
  gl_Position = clip_from_model * vertex;
}
)";

const char* const depth_glsl = R"(#version 330 core
in float surface_depth;
out vec4 depth;
void main() { depth = vec4(surface_depth); }
)";

const char* const colour_glsl = R"(
in vec3 surface_normal_ws, surface_albedo;
in float surface_ao;
uniform sampler2D screen_ao;
uniform float show;  // 0: plain, 1: lit, 2: ao
uniform float is_character;
out vec4 colour;
void main() {
  // OGRE draws into textures upside down.
  int height = textureSize(screen_ao, 0).y;
  float screen = texelFetch(screen_ao, ivec2(gl_FragCoord.x, height - 1 - int(gl_FragCoord.y)), 0).r;
  float ao = is_character > 0.5 ? surface_ao : screen;
  vec3 n = normalize(surface_normal_ws);
  colour = vec4(show > 1.5 ? vec3(ao) : lit(surface_albedo, n, show > 0.5 ? ao : 1.0), 1.0);
}
)";

Ogre::Vector3 vector_of(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

// Sets the transformation of a bone relative to its parent: translation, rotation and uniform scale.
void set_local(Ogre::Bone& bone, const glm::mat4& local) {
  const float scale = std::cbrt(glm::determinant(glm::mat3(local)));
  const glm::quat rotation = glm::quat_cast(glm::mat3(local) / scale);
  bone.setPosition(vector_of(glm::vec3(local[3])));
  bone.setOrientation(rotation.w, rotation.x, rotation.y, rotation.z);
  bone.setScale(scale, scale, scale);
}

// Returns the parent joint of a joint, as an index into the skin, or -1.
int joint_above(const viewer::CharacterFile& file, std::size_t joint) {
  const std::vector<int>& joints = file.skins[0].joints;
  int node = file.nodes[std::size_t(joints[joint])].parent;
  for (; node >= 0; node = file.nodes[std::size_t(node)].parent)
    if (const auto found = std::ranges::find(joints, node); found != joints.end())
      return int(found - joints.begin());
  return -1;
}

// Makes bones at the places of the inverse bind matrices.
Ogre::SkeletonPtr make_skeleton(const viewer::CharacterFile& file) {
  const viewer::Skin& skin = file.skins[0];
  Ogre::SkeletonPtr skeleton = Ogre::SkeletonManager::getSingleton().create("skeleton", "General", true);
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
    skeleton->createBone(file.nodes[std::size_t(skin.joints[j])].name, Ogre::ushort(j));
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const int above = joint_above(file, j);
    Ogre::Bone* const bone = skeleton->getBone(Ogre::ushort(j));
    if (above >= 0) skeleton->getBone(Ogre::ushort(above))->addChild(bone);
    const glm::mat4 to_parent = above >= 0 ? skin.inverse_bind[std::size_t(above)] : glm::mat4(1);
    set_local(*bone, to_parent * glm::inverse(skin.inverse_bind[j]));
  }
  skeleton->setBindingPose();
  skeleton->load();
  return skeleton;
}

void pose_skeleton(const hosts::Scene& scene, Ogre::Skeleton& skeleton) {
  const viewer::Skin& skin = scene.file.skins[0];
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const int above = joint_above(scene.file, j);
    const glm::mat4 to_parent =
        above >= 0 ? glm::inverse(scene.global(skin.joints[std::size_t(above)])) : glm::mat4(1);
    Ogre::Bone* const bone = skeleton.getBone(Ogre::ushort(j));
    bone->setManuallyControlled(true);
    set_local(*bone, to_parent * scene.global(skin.joints[j]));
  }
}

Ogre::HardwareVertexBufferSharedPtr add_vertices(Ogre::VertexData& data, const std::vector<float>& values,
                                                 Ogre::VertexElementSemantic semantic,
                                                 Ogre::VertexElementType type, Ogre::ushort binding) {
  data.vertexDeclaration->addElement(binding, 0, type, semantic);
  const std::size_t size = Ogre::VertexElement::getTypeSize(type);
  auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      size, values.size() * 4 / size, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY, true);
  buffer->writeData(0, values.size() * 4, values.data(), true);
  data.vertexBufferBinding->setBinding(binding, buffer);
  return buffer;
}

struct Mesh {
  Ogre::MeshPtr mesh;
  Ogre::HardwareVertexBufferSharedPtr ao;
};

Mesh make_mesh(const std::string& name, const std::vector<viewer::Vertex>& vertices,
               const std::vector<std::uint32_t>& triangles) {
  Mesh out;
  out.mesh = Ogre::MeshManager::getSingleton().createManual(name, "General");
  auto* const data = new Ogre::VertexData;  // OGRE deletes it
  out.mesh->sharedVertexData = data;
  data->vertexCount = vertices.size();
  std::vector<float> positions, normals, albedos;
  for (const viewer::Vertex& v : vertices)
    for (int i = 0; i < 3; ++i) {
      positions.push_back(v.position[i]);
      normals.push_back(v.normal[i]);
      albedos.push_back(v.albedo[i]);
    }
  add_vertices(*data, positions, Ogre::VES_POSITION, Ogre::VET_FLOAT3, 0);
  add_vertices(*data, normals, Ogre::VES_NORMAL, Ogre::VET_FLOAT3, 1);
  add_vertices(*data, albedos, Ogre::VES_DIFFUSE, Ogre::VET_FLOAT3, 2);
  out.ao = add_vertices(*data, std::vector<float>(vertices.size(), 1), Ogre::VES_TEXTURE_COORDINATES,
                        Ogre::VET_FLOAT1, 3);
  Ogre::SubMesh* const part = out.mesh->createSubMesh();
  part->indexData->indexCount = triangles.size();
  part->indexData->indexBuffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
      Ogre::HardwareIndexBuffer::IT_32BIT, triangles.size(), Ogre::HardwareBuffer::HBU_STATIC);
  part->indexData->indexBuffer->writeData(0, 4 * triangles.size(), triangles.data(), true);
  out.mesh->_setBounds(Ogre::AxisAlignedBox(-1e4f, -1e4f, -1e4f, 1e4f, 1e4f, 1e4f));
  out.mesh->_setBoundingSphereRadius(1e4f);
  return out;
}

Mesh make_character(const viewer::CharacterFile& file) {
  Mesh out = make_mesh("character", file.vertices, file.triangles);
  Ogre::SkeletonPtr skeleton = make_skeleton(file);
  out.mesh->_notifySkeleton(skeleton);
  for (std::size_t v = 0; v < file.vertices.size(); ++v)
    for (int k = 0; k < 4; ++k)
      if (file.vertices[v].weights[k] > 0)
        out.mesh->addBoneAssignment({unsigned(v), file.vertices[v].matrices[k], file.vertices[v].weights[k]});
  out.mesh->load();
  return out;
}

Ogre::HighLevelGpuProgramPtr make_program(const std::string& name, Ogre::GpuProgramType type,
                                          const std::string& source) {
  auto program =
      Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, "General", "glsl", type);
  program->setSource(source);
  if (type == Ogre::GPT_VERTEX_PROGRAM) {
    const Ogre::GpuProgramParametersSharedPtr defaults = program->getDefaultParameters();
    defaults->setNamedAutoConstant("clip_from_model", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
    defaults->setNamedAutoConstant("view_from_model", Ogre::GpuProgramParameters::ACT_WORLDVIEW_MATRIX);
  }
  program->load();
  return program;
}

Ogre::MaterialPtr make_material(const std::string& name, const std::string& fragment_program) {
  Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(name, "General");
  Ogre::Pass* const pass = material->getTechnique(0)->getPass(0);
  pass->setVertexProgram("vertex");
  pass->setFragmentProgram(fragment_program);
  pass->setCullingMode(Ogre::CULL_NONE);
  return material;
}

Ogre::TexturePtr make_target(const std::string& name, const hosts::Options& o, Ogre::PixelFormat format) {
  return Ogre::TextureManager::getSingleton().createManual(name, "General", Ogre::TEX_TYPE_2D,
                                                           Ogre::uint(o.width_px), Ogre::uint(o.height_px), 0,
                                                           format, Ogre::TU_RENDERTARGET);
}

std::vector<viewer::Vertex> ground_vertices(float half_size_m) {
  std::vector<viewer::Vertex> vertices;
  for (const float z : {1.0f, -1.0f})
    for (const float x : {-1.0f, 1.0f})
      vertices.push_back({{x * half_size_m, 0, z * half_size_m}, {0, 1, 0}, glm::vec3(0.42f), {}, {}});
  return vertices;
}

// Draws everything with the depth material while the depth texture is drawn.
struct DepthMaterial : Ogre::RenderTargetListener {
  std::vector<Ogre::Entity*> entities;
  void set(const char* suffix) {
    for (Ogre::Entity* entity : entities) entity->setMaterialName(entity->getName() + suffix);
  }
  void preRenderTargetUpdate(const Ogre::RenderTargetEvent&) override { set("_depth"); }
  void postRenderTargetUpdate(const Ogre::RenderTargetEvent&) override { set("_colour"); }
};

void draw(const hosts::Options& o) {
  const hosts::Scene scene(o);
  if (scene.file.skins.size() != 1) throw std::runtime_error("this host needs a file with exactly one skin");
  Ogre::LogManager log;
  log.createLog("", true, false, true);
  Ogre::Root root("", "", "");
  root.loadPlugin(OGRE_PLUGIN_DIR "/RenderSystem_GL3Plus");
  root.setRenderSystem(root.getAvailableRenderers().at(0));
  root.initialise(false);
  Ogre::RenderWindow* const window =
      root.createRenderWindow("nook_host_ogre", unsigned(o.width_px), unsigned(o.height_px), false);
  hosts::start_counting_gl_errors();

  make_program("vertex", Ogre::GPT_VERTEX_PROGRAM, vertex_glsl);
  make_program("depth", Ogre::GPT_FRAGMENT_PROGRAM, depth_glsl);
  make_program("colour", Ogre::GPT_FRAGMENT_PROGRAM,
               std::string("#version 330 core\n") + hosts::light_glsl + colour_glsl);
  const Ogre::TexturePtr depth = make_target("depth", o, Ogre::PF_FLOAT32_R);
  const Ogre::TexturePtr screen_ao = make_target("screen_ao", o, Ogre::PF_BYTE_RGBA);
  Ogre::SceneManager* const manager = root.createSceneManager();
  Ogre::Camera* const camera = manager->createCamera("camera");
  Ogre::SceneNode* const eye = manager->getRootSceneNode()->createChildSceneNode();
  eye->attachObject(camera);
  eye->setFixedYawAxis(true);
  eye->setPosition(vector_of(scene.eye_ws));
  eye->lookAt(vector_of(scene.target_ws), Ogre::Node::TS_WORLD);
  camera->setFOVy(Ogre::Radian(scene.vertical_fov_rad));
  camera->setAspectRatio(float(o.width_px) / float(o.height_px));
  camera->setNearClipDistance(scene.near_m);
  camera->setFarClipDistance(scene.far_m);

  const Mesh body = make_character(scene.file);
  const Mesh ground = make_mesh("ground", ground_vertices(2 * scene.size_m), {0, 1, 2, 2, 1, 3});
  ground.mesh->load();
  DepthMaterial depth_material;
  for (const Mesh* mesh : {&body, &ground}) {
    const bool is_character = mesh == &body;
    const std::string name = is_character ? "character" : "ground";
    Ogre::Entity* const entity = manager->createEntity(name, mesh->mesh);
    manager->getRootSceneNode()->createChildSceneNode()->attachObject(entity);
    make_material(name + "_depth", "depth");
    Ogre::Pass* const pass = make_material(name + "_colour", "colour")->getTechnique(0)->getPass(0);
    pass->createTextureUnitState("screen_ao")->setTextureFiltering(Ogre::TFO_NONE);
    const auto values = pass->getFragmentProgramParameters();
    values->setNamedConstant("show", o.show == "ao" ? 2.0f : o.show == "lit" ? 1.0f : 0.0f);
    values->setNamedConstant("is_character", is_character ? 1.0f : 0.0f);
    depth_material.entities.push_back(entity);
  }
  Ogre::Entity* const character = depth_material.entities[0];
  pose_skeleton(scene, *character->getSkeleton());

  Ogre::Viewport* const first = depth->getBuffer()->getRenderTarget()->addViewport(camera);
  first->setBackgroundColour(Ogre::ColourValue(1e6f, 1e6f, 1e6f, 1e6f));
  first->setOverlaysEnabled(false);
  depth->getBuffer()->getRenderTarget()->addListener(&depth_material);
  window->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.66f, 0.70f, 0.76f));

  const std::vector<unsigned char> model = platform::read_file(o.model);
  std::unique_ptr<NookOgre> nook;
  if (o.path != "none") {
    nook_gl_desc gl = nook::gl_desc();
    gl.get_proc = hosts::gl_proc;
    gl.state_mode = o.state_mode();
    nook = std::make_unique<NookOgre>(*character, body.ao, model.data(), model.size(), gl);
    nook->listen(depth, screen_ao, *camera, 0.2f * scene.size_m);
  }
  for (int frame = 0; frame < 3; ++frame) {
    if (o.path == "gpu") nook->update_on_gpu();
    if (o.path == "cpu") nook->update_on_cpu();
    root.renderOneFrame();
  }
  std::vector<unsigned char> rgb(3 * std::size_t(o.width_px) * std::size_t(o.height_px));
  window->copyContentsToMemory(
      Ogre::Box(0, 0, Ogre::uint32(o.width_px), Ogre::uint32(o.height_px)),
      Ogre::PixelBox(Ogre::uint32(o.width_px), Ogre::uint32(o.height_px), 1, Ogre::PF_BYTE_RGB, rgb.data()));
  hosts::finish("ogre", o, rgb.data());
  depth->getBuffer()->getRenderTarget()->removeAllListeners();  // they end before OGRE does
  nook.reset();
}

}  // namespace

int main(int argc, char** argv) {
  return hosts::run("nook_host_ogre", argc, argv, draw);
}
