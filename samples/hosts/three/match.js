// Counts the vertices that NookThree matches wrongly, in a character that the GLTFLoader has loaded. match_test.mjs calls it in
// the browser.
import { load } from "nook-web";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { NookThree } from "./nook_three.js";
import { shuffle } from "./shuffle.js";

const nook = await load(), renderer = new THREE.WebGLRenderer(), host = new NookThree(nook, renderer);

// Returns the first vertex in the model of each primitive of the file, by "mesh/primitive". In the model, primitives are in the
// order of the nodes.
function firstVertices(json, model) {
  const first = new Map();
  let count = 0;
  for (const { mesh } of json.nodes)
    for (const primitive of (mesh === undefined ? [] : json.meshes[mesh].primitives.keys())) {
      if (first.has(`${mesh}/${primitive}`)) throw new Error(`two nodes have mesh ${mesh}; the right answer is not known`);
      first.set(`${mesh}/${primitive}`, model.primitive(count++).first);
    }
  if (count !== model.info.primitiveCount) throw new Error(`the file has ${count} primitives, the model ${model.info.primitiveCount}`);
  return first;
}

// Returns a pose in which vertices with different weights have different AO, because each bone is turned and moved
// independently.
function pose(boneCount, seed) {
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647 - 0.5;
  const matrix = new THREE.Matrix4(), transforms = [];
  for (let bone = 0; bone < boneCount; ++bone) {
    matrix.makeRotationFromEuler(new THREE.Euler(random(), random(), random())).setPosition(0.2 * random(), 0.2 * random(), 0.2 * random());
    transforms.push(...matrix.clone().transpose().elements.slice(0, 12));
  }
  return { layout: "rows-3x4", transforms };
}

// Matches the vertices in the loader's order, or shuffled. A match is wrong if its AO differs from the right vertex's AO in any
// of four poses. Returns { vertices, wrong, ambiguous, most }; most is the largest difference.
export async function measure(name, isShuffled) {
  const gltf = await new GLTFLoader().loadAsync(`match/${name}.glb`);
  const model = nook.loadCharacter(await (await fetch(`match/${name}.nook`)).arrayBuffer());
  const first = firstVertices(gltf.parser.json, model), meshes = [];
  gltf.scene.traverse((node) => node.isMesh && meshes.push(node));
  meshes.sort((a, b) => Boolean(b.isSkinnedMesh) - Boolean(a.isSkinnedMesh));
  const expected = meshes.flatMap((mesh) => {
    const { meshes: of, primitives } = gltf.parser.associations.get(mesh), from = first.get(`${of}/${primitives ?? 0}`);
    const { count } = mesh.geometry.attributes.position;
    return (isShuffled ? shuffle(mesh) : Array.from({ length: count }, (_, i) => i)).map((vertex) => from + vertex);
  });
  const says = [], warn = console.warn;
  console.warn = (text) => says.push(text);
  const character = host.add(model, ...meshes);
  console.warn = warn;
  const scene = nook.createScene(), id = scene.addInstance(model), difference = new Float32Array(expected.length);
  for (let seed = 1; seed <= 4; ++seed) {
    for (const [of, instance] of [[host.scene, character.instance], [scene, id]]) {
      of.setPose(instance, pose(model.info.boneCount, seed));
      of.update();
    }
    const mine = host.scene.readAo(character.instance), right = scene.readAo(id);
    expected.forEach((vertex, i) => (difference[i] = Math.max(difference[i], Math.abs(mine[i] - right[vertex]))));
  }
  host.remove(character);
  scene.destroy();
  model.destroy();
  return {
    vertices: expected.length,
    // Equal vertices have equal AO, except for rounding.
    wrong: difference.reduce((sum, value) => sum + (value > 1e-5), 0),
    ambiguous: says.reduce((sum, text) => sum + Number(/(\d+) of \d+ vertices fit several/.exec(text)[1]), 0),
    most: difference.reduce((a, b) => Math.max(a, b), 0),
  };
}
