// OpenSceneGraph draws a character that its shader skins, with Nook's ambient occlusion.
//
//   nook_host_osg CHARACTER.glb MODEL.nook --out PICTURE.png
//
// nook_osg.cpp is all that an OpenSceneGraph program needs.
#include <glm/gtc/type_ptr.hpp>
#include <osg/Depth>
#include <osg/Geode>
#include <osg/Program>
#include <osgViewer/Viewer>

#include "platform/file_bytes.h"
#include "samples/hosts/host.h"
#include "samples/hosts/osg/nook_osg.h"

namespace {

const char* const vertex_glsl = R"(#version 330 compatibility
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 3) in vec4 joints;
layout(location = 4) in vec4 weights;
layout(location = 5) in float ao;
uniform mat4 matrices[JOINTS];
uniform float is_character;
out vec3 surface_normal_ws, surface_albedo;
out float surface_ao;
void main() {
  mat4 skin = mat4(1.0);
  if (is_character > 0.5)
    skin = weights.x * matrices[int(joints.x)] + weights.y * matrices[int(joints.y)] +
           weights.z * matrices[int(joints.z)] + weights.w * matrices[int(joints.w)];
  surface_normal_ws = mat3(skin) * normal;
  surface_albedo = albedo;
  surface_ao = ao;
  gl_Position = gl_ModelViewProjectionMatrix * (skin * vec4(position, 1.0));
}
)";

const char* const colour_glsl = R"(
in vec3 surface_normal_ws, surface_albedo;
in float surface_ao;
uniform sampler2D screen_ao;
uniform float show;  // 0: plain, 1: lit, 2: ao
uniform float is_character;
out vec4 colour;
void main() {
  float ao = is_character > 0.5 ? surface_ao : texelFetch(screen_ao, ivec2(gl_FragCoord.xy), 0).r;
  vec3 n = normalize(surface_normal_ws);
  colour = vec4(show > 1.5 ? vec3(ao) : lit(surface_albedo, n, show > 0.5 ? ao : 1.0), 1.0);
}
)";

osg::ref_ptr<osg::Geometry> make_geometry(const std::vector<viewer::Vertex>& vertices,
                                          const std::vector<std::uint32_t>& triangles, bool is_character) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array, normals = new osg::Vec3Array,
                               albedos = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec4Array> joints = new osg::Vec4Array, weights = new osg::Vec4Array;
  for (const viewer::Vertex& v : vertices) {
    positions->push_back({v.position.x, v.position.y, v.position.z});
    normals->push_back({v.normal.x, v.normal.y, v.normal.z});
    albedos->push_back({v.albedo.x, v.albedo.y, v.albedo.z});
    joints->push_back(
        {float(v.matrices[0]), float(v.matrices[1]), float(v.matrices[2]), float(v.matrices[3])});
    weights->push_back({v.weights.x, v.weights.y, v.weights.z, v.weights.w});
  }
  geometry->setVertexArray(positions);  // OSG takes the bounds from it
  geometry->setVertexAttribArray(0, positions, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(1, normals, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(2, albedos, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(3, joints, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(4, weights, osg::Array::BIND_PER_VERTEX);
  geometry->addPrimitiveSet(
      new osg::DrawElementsUInt(GL_TRIANGLES, unsigned(triangles.size()), triangles.data()));
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setDataVariance(osg::Object::DYNAMIC);
  geometry->setCullingActive(false);
  geometry->getOrCreateStateSet()->addUniform(new osg::Uniform("is_character", is_character ? 1.0f : 0.0f));
  return geometry;
}

std::vector<viewer::Vertex> ground_vertices(float half_size_m) {
  std::vector<viewer::Vertex> vertices;
  for (const float z : {1.0f, -1.0f})
    for (const float x : {-1.0f, 1.0f})
      vertices.push_back({{x * half_size_m, 0, z * half_size_m}, {0, 1, 0}, glm::vec3(0.42f), {}, {}});
  return vertices;
}

osg::ref_ptr<osg::Texture2D> make_texture(const hosts::Options& o, GLint internal_format, GLenum format,
                                          GLenum type) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
  texture->setTextureSize(o.width_px, o.height_px);
  texture->setInternalFormat(internal_format);
  texture->setSourceFormat(format);
  texture->setSourceType(type);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  return texture;
}

osg::Vec3 vector_of(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

struct ReadPixels : osg::Camera::DrawCallback {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  int width, height;
  ReadPixels(int w, int h) : width(w), height(h) {}
  void operator()(osg::RenderInfo&) const override {
    image->readPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE);
  }
};

struct CountErrors : osg::GraphicsOperation {
  CountErrors() : osg::GraphicsOperation("count errors", false) {}
  void operator()(osg::GraphicsContext*) override { hosts::start_counting_gl_errors(); }
};

osg::ref_ptr<osg::Program> make_program(const std::string& fragment, std::size_t joints) {
  std::string vertex = vertex_glsl;
  vertex.replace(vertex.find("JOINTS"), 6, std::to_string(joints));
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
  return program;
}

void draw(const hosts::Options& o) {
  const hosts::Scene scene(o);
  if (scene.file.skins.size() != 1) throw std::runtime_error("this host needs a file with exactly one skin");
  const std::size_t joints = scene.file.skins[0].joints.size();
  std::vector<osg::Matrixf> pose;
  osg::ref_ptr<osg::Uniform> matrices = new osg::Uniform(osg::Uniform::FLOAT_MAT4, "matrices", int(joints));
  for (std::size_t j = 0; j < joints; ++j) {
    pose.emplace_back(glm::value_ptr(scene.pose.matrices[j]));
    matrices->setElement(unsigned(j), pose.back());
  }
  osg::ref_ptr<osg::Group> world = new osg::Group;
  const auto character = make_geometry(scene.file.vertices, scene.file.triangles, true);
  for (const auto& geometry :
       {character, make_geometry(ground_vertices(2 * scene.size_m), {0, 1, 2, 2, 1, 3}, false)}) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    world->addChild(geode);
  }
  world->getOrCreateStateSet()->addUniform(matrices);
  world->getOrCreateStateSet()->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);

  const auto depth = make_texture(o, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT);
  const auto screen_ao = make_texture(o, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
  const osg::Matrixd view =
      osg::Matrixd::lookAt(vector_of(scene.eye_ws), vector_of(scene.target_ws), {0, 1, 0});
  const osg::Matrixd projection =
      osg::Matrixd::perspective(glm::degrees(scene.vertical_fov_rad), double(o.width_px) / o.height_px,
                                double(scene.near_m), double(scene.far_m));
  osg::ref_ptr<osg::Camera> depth_camera = new osg::Camera;
  depth_camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  depth_camera->setRenderOrder(osg::Camera::PRE_RENDER);
  depth_camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  depth_camera->attach(osg::Camera::DEPTH_BUFFER, depth);
  depth_camera->setViewport(0, 0, o.width_px, o.height_px);
  depth_camera->setClearMask(GL_DEPTH_BUFFER_BIT);
  depth_camera->addChild(world);
  depth_camera->getOrCreateStateSet()->setAttribute(
      make_program("#version 330 compatibility\nvoid main() {}\n", joints));

  osg::ref_ptr<osg::Group> lit = new osg::Group, root = new osg::Group;
  lit->addChild(world);
  osg::StateSet* const look = lit->getOrCreateStateSet();
  look->setAttribute(
      make_program(std::string("#version 330 compatibility\n") + hosts::light_glsl + colour_glsl, joints));
  look->setTextureAttribute(0, screen_ao);
  look->addUniform(new osg::Uniform("screen_ao", 0));
  look->addUniform(new osg::Uniform("show", o.show == "ao" ? 2.0f : o.show == "lit" ? 1.0f : 0.0f));
  root->addChild(depth_camera);
  root->addChild(lit);

  osgViewer::Viewer viewer;
  viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
  viewer.setUpViewInWindow(0, 0, o.width_px, o.height_px);
  viewer.setSceneData(root);
  viewer.setRealizeOperation(new CountErrors);
  viewer.getCamera()->setClearColor({0.66f, 0.70f, 0.76f, 1});
  for (osg::Camera* camera : {viewer.getCamera(), depth_camera.get()}) {
    camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setViewMatrix(view);
    camera->setProjectionMatrix(projection);
  }
  osg::ref_ptr<ReadPixels> pixels = new ReadPixels(o.width_px, o.height_px);
  viewer.getCamera()->setFinalDrawCallback(pixels);

  const std::vector<unsigned char> model = platform::read_file(o.model);
  osg::ref_ptr<NookOsg> nook;
  if (o.path != "none") {
    nook_gl_desc gl = nook::gl_desc();
    gl.get_proc = hosts::gl_proc;
    gl.state_mode = o.state_mode();
    nook = new NookOsg(character, model.data(), model.size(), gl, o.path == "gpu");
    nook->listen(depth_camera, depth, screen_ao, 0.2f * scene.size_m);
  }
  viewer.realize();
  for (int frame = 0; frame < 3; ++frame) {
    if (nook) nook->set_pose(pose, 0);
    viewer.frame();
  }
  pixels->image->flipVertical();
  hosts::finish("osg", o, pixels->image->data());
}

}  // namespace

int main(int argc, char** argv) {
  return hosts::run("nook_host_osg", argc, argv, draw);
}
