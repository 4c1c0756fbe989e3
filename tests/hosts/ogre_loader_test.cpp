// Matches of what OGRE loads: each primitive of a shared character becomes a submesh, is written and read by
// OGRE's own serializer, and keeps the four weights that OGRE keeps. The right answers are known, because
// OGRE keeps the order of vertices; shuffled meshes stand for tools that do not.
#include <nook/nook_character.h>

#include <Ogre.h>
#include <OgreDefaultHardwareBufferManager.h>
#include <OgreMeshSerializer.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>

#include "sdk/src/character/model_file.h"
#include "tests/bakers/character/engine.h"
#include "tests/bakers/character/unfitted_model.h"
#include "tests/catch.h"

using namespace nook;

namespace {

constexpr std::uint32_t influences = OGRE_MAX_BLEND_WEIGHTS;

std::filesystem::path characters() {
  const char* assets = std::getenv("NOOK_ASSETS");
  return std::filesystem::path(assets ? assets : NOOK_ASSETS_DIR) / "characters";
}

// What Nook needs of a submesh, as OGRE has it.
struct LoadedPart {
  std::vector<float> position, normal;
  std::vector<std::uint16_t> joint;
  std::vector<float> weight;
};

void add_floats(Ogre::VertexData& data, Ogre::VertexElementSemantic semantic, Ogre::ushort binding,
                const std::vector<float>& values) {
  data.vertexDeclaration->addElement(binding, 0, Ogre::VET_FLOAT3, semantic);
  const auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      12, values.size() / 3, Ogre::HardwareBuffer::HBU_STATIC);
  buffer->writeData(0, 4 * values.size(), values.data());
  data.vertexBufferBinding->setBinding(binding, buffer);
}

std::vector<float> read_floats(const Ogre::VertexData& data, Ogre::VertexElementSemantic semantic) {
  const Ogre::VertexElement* const element = data.vertexDeclaration->findElementBySemantic(semantic);
  REQUIRE(element);
  REQUIRE(element->getType() == Ogre::VET_FLOAT3);
  const auto buffer = data.vertexBufferBinding->getBuffer(element->getSource());
  const Ogre::HardwareBufferLockGuard lock(buffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
  std::vector<float> values;
  for (std::size_t v = 0; v < data.vertexCount; ++v) {
    float* at = nullptr;
    element->baseVertexPointerToElement(static_cast<unsigned char*>(lock.pData) + v * buffer->getVertexSize(),
                                        &at);
    values.insert(values.end(), at, at + 3);
  }
  return values;
}

// order: vertices of the file, of one primitive.
void add_part(Ogre::Mesh& mesh, const test::Engine& engine, std::span<const std::uint32_t> order) {
  Ogre::SubMesh* const part = mesh.createSubMesh();
  part->useSharedVertices = false;
  part->vertexData = new Ogre::VertexData;  // OGRE deletes it
  part->vertexData->vertexCount = order.size();
  std::vector<float> position, normal;
  for (std::uint32_t v = 0; v < order.size(); ++v) {
    const test::Engine::Vertex& vertex = engine.vertices[order[v]];
    for (const double p : vertex.position) position.push_back(static_cast<float>(p));
    normal.insert(normal.end(), vertex.normal.begin(), vertex.normal.end());
    for (const auto& [joint, weight] : vertex.weights)
      part->addBoneAssignment({v, static_cast<Ogre::ushort>(joint), weight});
  }
  add_floats(*part->vertexData, Ogre::VES_POSITION, 0, position);
  add_floats(*part->vertexData, Ogre::VES_NORMAL, 1, normal);
  // A triangle, because OGRE writes no submesh without.
  const std::uint16_t triangle[] = {0, 1, 2};
  part->indexData->indexCount = 3;
  part->indexData->indexBuffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
      Ogre::HardwareIndexBuffer::IT_16BIT, 3, Ogre::HardwareBuffer::HBU_STATIC);
  part->indexData->indexBuffer->writeData(0, sizeof triangle, triangle);
}

LoadedPart read_part(Ogre::Mesh& mesh, const Ogre::SubMesh& part) {
  LoadedPart out;
  const std::size_t count = part.vertexData->vertexCount;
  out.position = read_floats(*part.vertexData, Ogre::VES_POSITION);
  out.normal = read_floats(*part.vertexData, Ogre::VES_NORMAL);
  Ogre::SubMesh::VertexBoneAssignmentList weights = part.getBoneAssignments();
  mesh._rationaliseBoneAssignments(count, weights);
  if (weights.empty()) return out;
  out.joint.resize(influences * count);
  out.weight.resize(influences * count);
  std::vector<std::uint32_t> used(count);
  for (const auto& [vertex, assignment] : weights) {
    const std::size_t at = influences * vertex + used[vertex]++;
    out.joint[at] = assignment.boneIndex;
    out.weight[at] = assignment.weight;
  }
  return out;
}

// Through OGRE's file format and back.
std::vector<LoadedPart> loaded_by_ogre(const test::Engine& engine,
                                       const std::vector<std::vector<std::uint32_t>>& orders) {
  static int number = 0;
  const auto make = [&] {
    return Ogre::MeshManager::getSingleton().createManual("mesh" + std::to_string(number++), "General");
  };
  const Ogre::MeshPtr written = make(), read = make();
  for (const auto& order : orders) add_part(*written, engine, order);
  written->_setBounds(Ogre::AxisAlignedBox(-1, -1, -1, 1, 1, 1));
  Ogre::MeshSerializer serializer;
  const auto stream = std::make_shared<Ogre::MemoryDataStream>(std::size_t{64} << 20);
  serializer.exportMesh(written.get(), stream);
  stream->seek(0);
  serializer.importMesh(stream, read.get());
  std::vector<LoadedPart> parts;
  for (unsigned p = 0; p < read->getNumSubMeshes(); ++p)
    parts.push_back(read_part(*read, *read->getSubMesh(Ogre::ushort(p))));
  return parts;
}

struct Model {
  nook_context context = nullptr;
  nook_model model = nullptr;
  CharacterModel plain;

  explicit Model(const bake::ImportedCharacter& character) {
    const std::vector<std::byte> bytes = write_character_model(test::unfitted_model(character));
    plain = read_character_model(bytes);
    nook_context_desc desc;
    nook_context_desc_init(&desc);
    REQUIRE(nook_context_create(&desc, &context) == NOOK_OK);
    REQUIRE(nook_model_load(context, bytes.data(), bytes.size(), &model) == NOOK_OK);
  }
  ~Model() {
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
};

struct Counts {
  std::size_t vertices = 0, wrong = 0, ambiguous = 0, unmatched = 0;
};

Counts match(const Model& model, const test::Engine& engine, bool shuffles) {
  std::vector<std::vector<std::uint32_t>> orders;
  std::mt19937 random(1);
  for (const PrimitiveRange& range : model.plain.primitives) {
    orders.emplace_back(range.vertex_count);
    std::iota(orders.back().begin(), orders.back().end(), range.first_vertex);
    if (shuffles) std::shuffle(orders.back().begin(), orders.back().end(), random);
  }
  const std::vector<LoadedPart> parts = loaded_by_ogre(engine, orders);
  REQUIRE(parts.size() == orders.size());
  Counts counts;
  const auto& welded = model.plain.file_to_welded;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    nook_vertex_match_desc desc;
    REQUIRE(nook_vertex_match_desc_init(&desc) == NOOK_OK);
    desc.vertex_count = static_cast<std::uint32_t>(orders[p].size());
    desc.positions = parts[p].position.data();
    desc.normals = parts[p].normal.data();
    desc.primitive = static_cast<std::int32_t>(p);
    const int skin = engine.vertices[orders[p].front()].skin;
    if (skin >= 0 && !parts[p].joint.empty()) {
      desc.joints = parts[p].joint.data();
      desc.weights = parts[p].weight.data();
      desc.influences = influences;
      desc.skin = static_cast<std::uint32_t>(skin);
    }
    std::vector<std::uint32_t> found(orders[p].size());
    nook_vertex_match_info info{};
    info.struct_size = sizeof info;
    REQUIRE(nook_model_match_vertices(model.model, &desc, found.data(), &info) == NOOK_OK);
    counts.vertices += found.size();
    counts.ambiguous += info.ambiguous;
    counts.unmatched += info.unmatched;
    for (std::size_t v = 0; v < found.size(); ++v)
      counts.wrong += found[v] == NOOK_NO_VERTEX || welded[found[v]] != welded[orders[p][v]];
  }
  return counts;
}

}  // namespace

TEST_CASE("shared characters match what OGRE's loader makes of them") {
  Ogre::LogManager log;
  log.createLog("", true, false, true);
  Ogre::Root root("", "", "");
  Ogre::DefaultHardwareBufferManager buffers;
  std::vector<std::filesystem::path> files;
  if (std::filesystem::exists(characters()))
    for (const auto& entry : std::filesystem::directory_iterator(characters()))
      if (entry.path().extension() == ".glb") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::printf("%-36s %-9s %8s %6s %9s %9s\n", "character", "order", "vertices", "wrong", "ambiguous",
              "unmatched");
  for (const std::filesystem::path& path : files) {
    const test::Engine engine(path);
    const Model model(engine.imported);
    for (const bool shuffles : {false, true}) {
      const Counts counts = match(model, engine, shuffles);
      std::printf("%-36s %-9s %8zu %6zu %9zu %9zu\n", path.filename().c_str(),
                  shuffles ? "shuffled" : "OGRE's", counts.vertices, counts.wrong, counts.ambiguous,
                  counts.unmatched);
      CHECK(counts.unmatched == 0);
      CHECK(counts.wrong <= counts.ambiguous);
      if (!shuffles) CHECK(counts.ambiguous == 0);
    }
  }
  Ogre::MeshManager::getSingleton().removeAll();
}
