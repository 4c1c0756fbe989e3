// The functions that the test of the page (../test.mjs) calls in the browser.
import { Program, depthTarget, texture } from "./program.js";

const largest = (a, b) => {
  let most = 0;
  for (let i = 0; i < a.length; ++i) most = Math.max(most, Math.abs(a[i] - b[i]));
  return most;
};

export function makeChecks(page) {
  const { nook, character, webgl } = page;

  // Returns the scene that the native program evaluated.
  function expectedScene() {
    const scene = nook.createScene();
    const { expected_poses: poses } = character.arrays;
    const floats = 12 * character.bones;
    const ids = [0, 1].map((i) => {
      const id = scene.addInstance(page.model);
      scene.setGround(id, [0, 1, 0, 0]);
      const transforms = poses.subarray(i * floats, (i + 1) * floats);
      scene.setPose(id, { kind: "rest-to-world", layout: "rows-3x4", transforms });
      return id;
    });
    scene.link(ids[0], ids[1]);
    scene.link(ids[1], ids[0]);
    return { scene, ids };
  }

  // Reads values from one of Nook's buffers with the page's own calls.
  function readBuffer({ buffer, offset, count }) {
    const values = new Float32Array(count);
    webgl.bindBuffer(webgl.COPY_READ_BUFFER, buffer);
    webgl.getBufferSubData(webgl.COPY_READ_BUFFER, offset, values);
    webgl.bindBuffer(webgl.COPY_READ_BUFFER, null);
    return values;
  }

  return {
    // Returns the largest differences of AO over all vertices: the CPU in WebAssembly and WebGL, against native and against
    // each other.
    characters() {
      const { scene, ids } = expectedScene();
      const { ao } = page.renderer;
      scene.update();
      const cpu = ids.map((id) => scene.readAo(id));
      ao.update(scene);
      const gpu = ids.map((id) => readBuffer(ao.view(scene, id)));
      const native = [0, 1].map((i) => character.arrays.expected_ao.subarray(i * character.vertices, (i + 1) * character.vertices));
      const differences = {
        cpuNative: Math.max(...[0, 1].map((i) => largest(cpu[i], native[i]))),
        gpuNative: Math.max(...[0, 1].map((i) => largest(gpu[i], native[i]))),
        gpuCpu: Math.max(...[0, 1].map((i) => largest(gpu[i], cpu[i]))),
        mean: gpu[0].reduce((sum, value) => sum + value, 0) / gpu[0].length,
      };
      // Directional occlusion.
      for (const id of ids) scene.setLight(id, page.lobes);
      scene.update();
      ao.update(scene);
      differences.directional = Math.max(...ids.map((id) => largest(ao.read(scene, id, "directional-ao"), scene.readDirectionalAo(id))));
      ao.release(scene);
      scene.destroy();
      return differences;
    },

    // Runs Nook's pass on uploaded linear depth, and compares it with expected bytes. Returns the share of pixels within 1/255,
    // and the largest difference.
    screen({ width, height, depth, normals, expected, projection, radius }) {
      const gl = webgl;
      const upload = (format, channels, data) => {
        const texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, channels, gl.FLOAT, data);
        gl.bindTexture(gl.TEXTURE_2D, null);
        return texture;
      };
      const texture = upload(gl.R32F, gl.RED, depth), normalTexture = upload(gl.RGBA32F, gl.RGBA, normals);
      const pass = page.renderer.ao.createNnao({ maxWidth: width, maxHeight: height });
      pass.render({ depthTexture: texture, depthKind: "linear", normalTexture, show: "raw", width, height, projection, radius });
      const framebuffer = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, pass.texture, 0);
      const pixels = new Uint8Array(4 * width * height);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      gl.deleteFramebuffer(framebuffer);
      gl.deleteTexture(texture);
      gl.deleteTexture(normalTexture);
      pass.destroy();
      let near = 0, most = 0, sum = 0;
      for (let i = 0; i < width * height; ++i) {
        const off = Math.abs(pixels[4 * i] - expected[i]);
        near += off <= 1;
        most = Math.max(most, off);
        sum += pixels[4 * i];
      }
      return { share: near / (width * height), most, mean: sum / (255 * width * height) };
    },
    async screenFiles() {
      const description = await (await fetch("data/screen.json")).json();
      const bytes = await (await fetch("data/screen.bin")).arrayBuffer();
      const count = description.width * description.height;
      return this.screen({ ...description, depth: new Float32Array(bytes, 0, count), normals: new Float32Array(bytes, 4 * count, 4 * count),
        expected: new Uint8Array(bytes, 20 * count, count) });
    },

    // Draws the native program's picture of the expected scene again, with the native program's shaders. Returns the share of
    // pixels within two steps of 255 in every channel, and the mean difference in steps.
    async picture() {
      const gl = webgl, { ao } = page.renderer;
      const description = await (await fetch("data/picture.json")).json();
      const bytes = await (await fetch("data/picture.bin")).arrayBuffer();
      const array = (type, name) => new type(bytes, description.arrays[name].offset, description.arrays[name].length);
      const { width, height, clip_from_world } = description;
      const triangles = array(Uint32Array, "triangles");
      const bodies = gl.createVertexArray();
      gl.bindVertexArray(bodies);
      const buffers = [[gl.ARRAY_BUFFER, array(Float32Array, "positions")], [gl.ARRAY_BUFFER, array(Float32Array, "normals")],
        [gl.ELEMENT_ARRAY_BUFFER, triangles]].map(([target, data]) => {
        const made = gl.createBuffer();
        gl.bindBuffer(target, made);
        gl.bufferData(target, data, gl.STATIC_DRAW);
        return made;
      });
      const pointAt = (vertex) => [0, 1].forEach((slot) => {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffers[slot]);
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 12, 12 * vertex);
      });
      // views: the AO of both instances; leave it out to draw only depth.
      const draw = (target, program, values, views) => {
        gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
        gl.viewport(0, 0, width, height);
        gl.enable(gl.DEPTH_TEST);
        gl.clearColor(1, 1, 1, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        program.use({ clip_from_world, ...values });
        gl.bindVertexArray(bodies);
        for (const body of [0, 1]) {
          pointAt(body * character.vertices);
          if (views) {
            const { buffer, stride, offset } = views[body];
            gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
            gl.enableVertexAttribArray(2);
            gl.vertexAttribPointer(2, 1, gl.FLOAT, false, stride, offset);
          }
          gl.drawElements(gl.TRIANGLES, triangles.length - 6, gl.UNSIGNED_INT, 0);
        }
        pointAt(0);
        gl.disableVertexAttribArray(2);
        gl.vertexAttrib1f(2, 1);
        gl.drawElements(gl.TRIANGLES, 6, gl.UNSIGNED_INT, 4 * (triangles.length - 6));
      };
      const { scene, ids } = expectedScene();
      const depth = depthTarget(gl, width, height), picture = depthTarget(gl, width, height);
      gl.bindFramebuffer(gl.FRAMEBUFFER, picture.framebuffer);
      const colour = texture(gl, gl.RGBA8, width, height);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colour, 0);
      gl.drawBuffers([gl.COLOR_ATTACHMENT0]);
      const pass = ao.createNnao({ maxWidth: width, maxHeight: height });
      draw(depth, new Program(gl, description.vertex, description.depth_fragment), {}, null);
      pass.render({ depthTexture: depth.depth, width, height, projection: description.projection, radius: description.radius });
      ao.update(scene);
      draw(picture, new Program(gl, description.vertex, description.fragment), { screen_ao: pass.texture },
        ids.map((id) => ao.view(scene, id)));
      const pixels = new Uint8Array(4 * width * height);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      gl.bindVertexArray(null);
      gl.useProgram(null);
      buffers.forEach((buffer) => gl.deleteBuffer(buffer));
      gl.deleteVertexArray(bodies);
      for (const each of [depth, picture]) gl.deleteFramebuffer(each.framebuffer);
      for (const each of [depth.depth, picture.depth, colour]) gl.deleteTexture(each);
      pass.destroy();
      ao.release(scene);
      scene.destroy();
      const expected = array(Uint8Array, "pixels");
      let near = 0, sum = 0;
      const colours = new Set();
      for (let i = 0; i < pixels.length; i += 4) {
        const off = [0, 1, 2].map((k) => Math.abs(pixels[i + k] - expected[i + k]));
        near += Math.max(...off) <= 2;
        sum += (off[0] + off[1] + off[2]) / 3;
        colours.add(pixels[i]);
      }
      return { share: near / (width * height), mean: sum / (width * height), colours: colours.size, error: gl.getError() };
    },

    // There is no CPU picture of the material, so this only evaluates a sample on the CPU, in WebAssembly.
    material() {
      const [value] = page.material.evaluate([{ uv: [0.3, 0.6], view: [0, 0, 1], light: [0.3, 0, 0.95] }]);
      return { radiance: [...value.radiance], visibility: value.visibility, textures: page.renderer.material.info.textureCount };
    },

    set(values) {
      Object.assign(page.state, values);
      page.makeLight();
      page.arrange();
      page.showPanel();
    },
    draw(seconds) {
      page.draw(seconds);
      return webgl.getError();
    },
    error() {
      return page.meanSquaredError();
    },

    // Draws frames for some seconds. Returns their number, the errors, and what has grown since the first frames.
    async frames(seconds) {
      const measure = () => ({ memory: nook.memoryBytes, objects: page.renderer.ao.objectCount });
      let start = null, count = 0, errors = 0;
      const began = performance.now();
      while (performance.now() - began < 1000 * seconds || count < 6) {
        // Without a window, the browser draws few frames. Reading a pixel waits until WebGL has drawn the frame.
        await new Promise((resolve) => setTimeout(resolve));
        page.draw(count / 30);
        webgl.readPixels(0, 0, 1, 1, webgl.RGBA, webgl.UNSIGNED_BYTE, new Uint8Array(4));
        errors += webgl.getError() !== webgl.NO_ERROR;
        if (++count === 3) start = measure();
      }
      return { count, errors, start, end: measure(), seconds: (performance.now() - began) / 1000 };
    },

    pixels() {
      const { drawingBufferWidth: width, drawingBufferHeight: height } = webgl;
      const pixels = new Uint8Array(4 * width * height);
      webgl.readPixels(0, 0, width, height, webgl.RGBA, webgl.UNSIGNED_BYTE, pixels);
      return pixels;
    },

    // Compares the picture before the context is lost with the picture after it is restored.
    async loss(seconds) {
      page.draw(seconds);
      const before = this.pixels();
      const extension = webgl.getExtension("WEBGL_lose_context");
      const event = (name) => new Promise((resolve) => webgl.canvas.addEventListener(name, resolve, { once: true }));
      const lost = event("webglcontextlost");
      extension.loseContext();
      await lost;
      // A browser restores a context only after the handlers of the event have returned.
      await new Promise((resolve) => setTimeout(resolve, 50));
      const back = event("webglcontextrestored");
      extension.restoreContext();
      await back;
      page.draw(seconds);
      const error = webgl.getError();
      return { most: largest(before, this.pixels()), error, objects: page.renderer.ao.objectCount };
    },
  };
}
