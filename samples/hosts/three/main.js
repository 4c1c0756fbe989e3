// The page: three characters of three.js on a ground, with AO from Nook. nook_three.js connects three.js and Nook.
import { load } from "nook-web";
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { EffectComposer } from "three/addons/postprocessing/EffectComposer.js";
import { OutputPass } from "three/addons/postprocessing/OutputPass.js";
import { RenderPass } from "three/addons/postprocessing/RenderPass.js";
import { clone } from "three/addons/utils/SkeletonUtils.js";
import { NookPass, NookThree } from "./nook_three.js";

const cast = [{ clip: "Sit", at: [-0.85, 0, 0], turn: 0.5 }, { clip: "Dance", at: [0, 0, -0.15], turn: 0 },
  { clip: "Crouch", at: [0.8, 0, 0.1], turn: -0.6 }];

// Code that the page would also have without Nook.
const renderer = new THREE.WebGLRenderer();
renderer.setSize(innerWidth, innerHeight);
renderer.shadowMap.enabled = true;
document.body.prepend(renderer.domElement);
const camera = new THREE.PerspectiveCamera(32, innerWidth / innerHeight, 0.1, 60);
camera.position.set(0.35, 1.3, 4);
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.set(0, 0.74, 0);
controls.update();
const world = new THREE.Scene();
world.background = new THREE.Color(0xd7dee8);
const sky = new THREE.HemisphereLight(0xe6efff, 0x9a8c7c, 2.6);
const sun = new THREE.DirectionalLight(0xfff0d8, 1.1);
sun.position.set(2.5, 4, 2);
sun.castShadow = true;
sun.shadow.mapSize.set(1024, 1024);
Object.assign(sun.shadow.camera, { left: -2.5, right: 2.5, top: 2.5, bottom: -2.5, far: 12 });
const ground = new THREE.Mesh(new THREE.PlaneGeometry(40, 40), new THREE.MeshStandardMaterial({ color: 0xb9b4aa, roughness: 1 }));
ground.rotation.x = -Math.PI / 2;
ground.receiveShadow = true;
world.add(sky, sun, ground);

const gltf = await new GLTFLoader().loadAsync("data/character.glb");
const actors = cast.map(({ clip, at, turn }) => {
  const body = clone(gltf.scene);
  const meshes = [];
  body.traverse((node) => node.isSkinnedMesh && meshes.push(node));
  for (const mesh of meshes) Object.assign(mesh, { castShadow: true, receiveShadow: true, frustumCulled: false });
  body.position.set(...at);
  body.rotation.y = turn;
  world.add(body);
  const mixer = new THREE.AnimationMixer(body);
  mixer.clipAction(gltf.animations.find(({ name }) => name === clip) ?? gltf.animations[0]).play();
  return { body, meshes, mixer };
});
const composer = new EffectComposer(renderer, new THREE.WebGLRenderTarget(innerWidth, innerHeight,
  { type: THREE.HalfFloatType, samples: 4, depthTexture: new THREE.DepthTexture(innerWidth, innerHeight) }));
const renderPass = new RenderPass(world, camera);
composer.addPass(renderPass);
composer.addPass(new OutputPass());

// Nook: one host for the renderer, one call for each character, one pass.
async function addNook() {
  const nook = await load();
  const model = nook.loadCharacter(await (await fetch("data/character.nook")).arrayBuffer());
  const host = new NookThree(nook, renderer);
  for (const actor of actors) actor.character = host.add(model, ...actor.meshes);
  host.scene.linkNearest(2, 2);
  const pass = new NookPass(host, camera, { radius: 0.4 });
  composer.insertPass(pass, 1);
  return { nook, model, host, pass };
}

let nook = null;
function draw(seconds) {
  if (renderer.getContext().isContextLost()) return;
  for (const { mixer } of actors) mixer.setTime(seconds);
  nook?.host.update(world);
  composer.render();
}

const page = { renderer, camera, world, sky, sun, ground, actors, composer, draw, addNook: async () => (nook = await addNook()) };
if (new URLSearchParams(location.search).has("test")) {
  globalThis.checks = (await import("./checks.js")).makeChecks(page);
} else {
  await page.addNook();
  const { characters, screen, moving } = document.forms[0].elements;
  let seconds = 0, last = performance.now();
  addEventListener("resize", () => {
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(innerWidth, innerHeight);
    composer.setSize(innerWidth, innerHeight);
  });
  renderer.setAnimationLoop((now) => {
    if (moving.checked) seconds += (now - last) / 1000;
    last = now;
    nook.host.share.value = Number(characters.checked);
    nook.pass.enabled = screen.checked;
    draw(seconds);
  });
}
