// The functions that test.mjs calls in the browser.
import * as THREE from "three";
import { shuffle } from "./shuffle.js";

const largest = (a, b) => a.reduce((most, value, i) => Math.max(most, Math.abs(value - b[i])), 0);

export function makeChecks(page) {
  const { renderer, composer, actors } = page;
  const webgl = renderer.getContext();
  const seconds = 0.7;
  let nook = null;

  function pixels() {
    const { drawingBufferWidth: width, drawingBufferHeight: height } = webgl;
    const bytes = new Uint8Array(4 * width * height);
    webgl.bindFramebuffer(webgl.FRAMEBUFFER, null);
    webgl.readPixels(0, 0, width, height, webgl.RGBA, webgl.UNSIGNED_BYTE, bytes);
    return bytes;
  }
  function picture(characters, screen, at = seconds) {
    if (nook) {
      nook.host.share.value = characters;
      nook.pass.enabled = screen;
    }
    page.draw(at);
    return pixels();
  }
  function attributeOf({ geometry: { attributes: { nookAo } } }) {
    const values = new Float32Array(nookAo.count);
    webgl.bindBuffer(webgl.COPY_READ_BUFFER, nookAo.buffer);
    webgl.getBufferSubData(webgl.COPY_READ_BUFFER, 0, values);
    webgl.bindBuffer(webgl.COPY_READ_BUFFER, null);
    return values;
  }
  // Returns the colour before the OutputPass, linear and in half floats.
  function linearColour() {
    const { width, height } = composer.writeBuffer;
    const halves = new Uint16Array(4 * width * height);
    renderer.readRenderTargetPixels(composer.writeBuffer, 0, 0, width, height, halves);
    return Float32Array.from(halves, THREE.DataUtils.fromHalfFloat);
  }
  // The vertex orders of the meshes that were shuffled.
  const orders = new Map();
  // Moves the second half of a mesh's triangles to a new mesh on the same skeleton.
  function split({ meshes }) {
    const [mesh] = meshes, part = mesh.clone(false);
    mesh.parent.add(part);
    meshes.push(part);
    orders.set(part, shuffle(part));
    mesh.geometry = mesh.geometry.clone();
    for (const [half, each] of meshes.entries()) {
      const { array } = each.geometry.index, middle = 3 * Math.floor(array.length / 6);
      each.geometry.setIndex(Array.from(half ? array.slice(middle) : array.slice(0, middle)));
    }
  }

  return {
    error: () => webgl.getError(),

    // Draws pictures with three.js alone, and while Nook runs but no material reads its AO. They must be equal. The last
    // character has its vertices in another order than the file, and the second character has two meshes.
    async plain() {
      orders.set(actors[2].meshes[0], shuffle(actors[2].meshes[0]));
      split(actors[1]);
      const plainMaterials = actors.map(({ meshes }) => meshes.map(({ material }) => material));
      const alone = picture(), again = picture();
      nook = await page.addNook();
      const own = actors.map(({ meshes }) => meshes.map(({ material }) => material));
      const use = (materials) => actors.forEach(({ meshes }, i) => meshes.forEach((mesh, j) => (mesh.material = materials[i][j])));
      use(plainMaterials);
      const beside = picture(1, false), besideAgain = picture(1, false);
      use(own);
      const shareZero = picture(0, false);
      return {
        repeat: largest(alone, again), beside: Math.max(largest(alone, beside), largest(alone, besideAgain)),
        shareZero: largest(alone, shareZero), colours: new Set(new Uint32Array(alone.buffer)).size,
      };
    },

    // Compares the AO attributes with AO from the CPU, for all characters at several times, in the order of the file. Also
    // checks that Nook has the vertices at the positions to which three.js skins them.
    characters() {
      const { host, model } = nook;
      const result = { difference: 0, least: 1, mean: 0, poses: [], vertices: 0 };
      for (const at of [0.1, 0.7, 1.3]) {
        page.draw(at);
        const scene = nook.nook.createScene();
        const ids = actors.map(({ character }) => {
          const id = scene.addInstance(model);
          scene.setPose(id, host.pose(character));
          return id;
        });
        for (const a of ids) for (const b of ids) if (a !== b) scene.link(a, b);
        scene.update();
        actors.forEach(({ meshes, character }, k) => {
          const cpu = scene.readAo(ids[k]);
          for (const mesh of meshes) {
            const gpu = attributeOf(mesh), order = orders.get(mesh) ?? gpu.map((_, i) => i);
            result.difference = Math.max(result.difference, largest(gpu, Array.from(gpu, (_, i) => cpu[order[i]])));
          }
          result.least = cpu.reduce((a, b) => Math.min(a, b), result.least);
          result.mean += cpu.reduce((a, b) => a + b, 0) / cpu.length / actors.length / 3;
          result.vertices = cpu.length;
          if (orders.has(meshes[0])) return;
          const rest = Array.from({ length: model.info.checkVertexCount }, (_, i) => model.checkVertex(i).vertex);
          const positions = rest.flatMap((v) => meshes[0].getVertexPosition(v, new THREE.Vector3())
            .applyMatrix4(meshes[0].matrixWorld).toArray());
          const check = model.checkPose(host.pose(character), { positions });
          result.poses.push({ fault: check.fault, maxError: check.maxError });
        });
        scene.destroy();
      }
      return result;
    },

    // Under ambient light alone, the picture with AO divided by the picture without AO is the AO of each pixel. Under the whole
    // light, pixels with low AO must darken, and open pixels must stay the same.
    darkening() {
      const { sky, sun } = page;
      picture(0, false);
      const lit = linearColour();
      picture(1, false);
      const litAo = linearColour();
      sun.visible = false;
      picture(0, false);
      const ambient = linearColour();
      picture(1, false);
      const ambientAo = linearColour();
      sun.visible = true;
      const groups = { low: { count: 0, sum: 0 }, open: { count: 0, sum: 0 } };
      let least = 1, outside = 0;
      for (let i = 0; i < lit.length; i += 4) {
        const ao = ambientAo[i] / ambient[i], share = litAo[i] / lit[i];
        least = Math.min(least, ao);
        outside += ao > 1.001;
        const group = ao < 0.5 ? groups.low : ao > 0.97 ? groups.open : null;
        if (group) ++group.count, (group.sum += share);
      }
      return {
        low: groups.low.count, lowShare: groups.low.sum / groups.low.count, open: groups.open.count,
        openShare: groups.open.sum / groups.open.count, least, outside, sky: sky.intensity,
      };
    },

    // The pass must multiply the colour by its AO, and must not change the sky.
    screen() {
      picture(1, false);
      const before = linearColour();
      picture(1, true);
      const after = linearColour();
      const { writeBuffer: { width, height, depthTexture } } = composer;
      const { nnao, frame, camera } = nook.pass;
      nnao.render({ width, height, depthTexture: renderer.properties.get(depthTexture).__webglTexture,
        projection: camera.projectionMatrix.elements, ...frame });
      const framebuffer = webgl.createFramebuffer();
      webgl.bindFramebuffer(webgl.FRAMEBUFFER, framebuffer);
      webgl.framebufferTexture2D(webgl.FRAMEBUFFER, webgl.COLOR_ATTACHMENT0, webgl.TEXTURE_2D, nnao.texture, 0);
      const ao = new Uint8Array(4 * width * height);
      webgl.readPixels(0, 0, width, height, webgl.RGBA, webgl.UNSIGNED_BYTE, ao);
      webgl.deleteFramebuffer(framebuffer);
      renderer.resetState();
      let most = 0, mean = 0, changed = 0;
      for (let i = 0; i < ao.length; i += 4) {
        most = Math.max(most, Math.abs(after[i] - before[i] * ao[i] / 255));
        mean += ao[i] / 255 / (width * height);
        changed += before[i] !== after[i];
      }
      return { most, mean, changed: changed / (width * height), skyKept: largest(before.slice(-4 * width), after.slice(-4 * width)) };
    },

    // Changes the size of the canvas and restores it.
    resize() {
      const before = picture(1, true), { width, height } = renderer.domElement;
      for (const [w, h] of [[width + 120, height - 50], [width, height]]) {
        renderer.setSize(w, h);
        composer.setSize(w, h);
        page.draw(seconds);
      }
      return { most: largest(before, picture(1, true)) };
    },

    // Returns the messages for a mesh that the model does not have, and for a composer without a depth texture.
    faults() {
      const textOf = (call) => {
        try {
          call();
          return "no error";
        } catch (error) {
          return error.message;
        }
      };
      return [textOf(() => nook.host.add(nook.model, new THREE.Mesh(new THREE.BoxGeometry(9, 9, 9)))),
        textOf(() => nook.pass.render(renderer, null, { width: 8, height: 8, texture: null, depthTexture: null }))];
    },

    // Compares the picture before the context is lost with the picture after it is restored.
    async loss() {
      const before = picture(1, true);
      const extension = webgl.getExtension("WEBGL_lose_context");
      const event = (name) => new Promise((resolve) => renderer.domElement.addEventListener(name, resolve, { once: true }));
      const lost = event("webglcontextlost");
      extension.loseContext();
      await lost;
      await new Promise((resolve) => setTimeout(resolve, 50));
      const back = event("webglcontextrestored");
      extension.restoreContext();
      await back;
      return { most: largest(before, picture(1, true)) };
    },

    // Frames in a lost context must be skipped without an error. A removed character must look as it does without Nook, and
    // must have AO again when it is added again. Options must reach the pass.
    async life() {
      const { host, model, pass } = nook;
      const before = picture(1, true);
      const extension = webgl.getExtension("WEBGL_lose_context");
      const event = (name) => new Promise((resolve) => renderer.domElement.addEventListener(name, resolve, { once: true }));
      const lost = event("webglcontextlost");
      extension.loseContext();
      host.update(page.world);
      await lost;
      page.draw(seconds);
      await new Promise((resolve) => setTimeout(resolve, 50));
      const back = event("webglcontextrestored");
      extension.restoreContext();
      await back;
      const restored = largest(before, picture(1, true));
      const actor = actors[0], material = actor.meshes[0].material, geometry = actor.meshes[0].geometry;
      host.remove(actor.character);
      const isOwn = actor.meshes[0].material !== material && actor.meshes[0].geometry !== geometry && !actor.meshes[0].geometry.attributes.nookAo;
      const removed = largest(before, picture(1, true));
      actor.character = host.add(model, ...actor.meshes);
      host.scene.linkNearest(2, 2);
      const added = largest(before, picture(1, true));
      pass.options = { preset: "best" };
      const best = largest(before, picture(1, true)), taps = pass.nnao.info.taps;
      pass.options = {};
      const same = largest(before, picture(1, true));
      return { restored, isOwn, removed, added, best, taps, same };
    },
    // The last check: none of Nook's objects may be left.
    end() {
      nook.pass.dispose();
      nook.pass.enabled = false;
      const { gl } = nook.host;
      nook.host.dispose();
      page.draw(seconds);
      return { objects: gl.objectCount, characters: nook.host.characters.length };
    },

    // Returns two pictures side by side as the bytes of a PNG file in base64: one without AO, and one with both kinds of AO.
    pair() {
      const { width, height } = renderer.domElement;
      const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height });
      const context = canvas.getContext("2d");
      [[0, false], [1, true]].forEach(([characters, screen], i) => {
        picture(characters, screen);
        context.drawImage(renderer.domElement, i * width, 0);
      });
      return canvas.toDataURL("image/png").split(",")[1];
    },
  };
}
