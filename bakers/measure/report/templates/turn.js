// Draws a body that turns, with WebGL 2. Positions are quantised, and AO has one byte per vertex.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("turn-data").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const canvas = document.getElementById("turn-canvas"), poses = document.getElementById("turn-pose");
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) {
    document.getElementById("turn-note").textContent = "This browser has no WebGL 2; the pictures above show the same body.";
    canvas.hidden = true;
    return;
  }
  const vertexText = `#version 300 es
    precision highp float; precision highp int;
    uniform mat4 view; uniform vec3 low; uniform vec3 size; uniform int show; uniform float errorEnd;
    layout(location = 0) in vec3 position; layout(location = 1) in float traced; layout(location = 2) in float model;
    out float value; out vec3 place;
    void main() {
      place = low + size * position;
      value = show == 0 ? traced : show == 1 ? model : abs(model - traced) / errorEnd;
      gl_Position = view * vec4(place, 1.0);
    }`;
  const fragmentText = `#version 300 es
    precision highp float; precision highp int;
    uniform vec3 ramp[${data.ramp.length}]; uniform int show; uniform vec3 eye;
    in float value; in vec3 place; out vec4 colour;
    void main() {
      float v = clamp(value, 0.0, 1.0);
      if (show < 2) { colour = vec4(vec3(v), 1.0); return; }
      float at = v * float(${data.ramp.length - 1});
      int i = min(int(at), ${data.ramp.length - 2});
      vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
      colour = vec4(mix(ramp[i], ramp[i + 1], at - float(i)) * (0.75 + 0.25 * abs(dot(normal, eye))), 1.0);
    }`;
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertexText], [gl.FRAGMENT_SHADER, fragmentText]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text.trimStart());
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const uniform = (name) => gl.getUniformLocation(program, name);
  const buffer = (kind, array) => {
    const made = gl.createBuffer();
    gl.bindBuffer(kind, made);
    gl.bufferData(kind, array, gl.STATIC_DRAW);
  };
  const indices = new Uint32Array(bytes(data.triangles).buffer);
  const shapes = data.poses.map((pose) => {
    const shape = gl.createVertexArray();
    gl.bindVertexArray(shape);
    buffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    buffer(gl.ARRAY_BUFFER, bytes(pose.positions));
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, true, 0, 0);
    buffer(gl.ARRAY_BUFFER, bytes(pose.traced));
    gl.vertexAttribPointer(1, 1, gl.UNSIGNED_BYTE, true, 0, 0);
    buffer(gl.ARRAY_BUFFER, bytes(pose.model));
    gl.vertexAttribPointer(2, 1, gl.UNSIGNED_BYTE, true, 0, 0);
    for (const at of [0, 1, 2]) gl.enableVertexAttribArray(at);
    const name = document.createElement("option");
    name.textContent = pose.name;
    poses.append(name);
    return shape;
  });
  const shows = ["traced", "model", "error"];
  const state = { show: 1, pose: 0, turn: 0.5, tilt: 0.15, near: 1 };

  function draw() {
    const width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio)), height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const { low, size } = data.poses[state.pose];
    const middle = low.map((l, i) => l + size[i] / 2), radius = 0.52 * Math.hypot(...size) / state.near;
    const [st, ct, sp, cp] = [Math.sin(state.turn), Math.cos(state.turn), Math.sin(state.tilt), Math.cos(state.tilt)];
    const right = [ct, 0, -st], up = [-sp * st, cp, -sp * ct], eye = [cp * st, sp, cp * ct];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const wide = Math.min(width, height), sx = wide / width / radius, sy = wide / height / radius, sz = -0.45 / Math.hypot(...size);
    const rows = [right.map((v) => v * sx), up.map((v) => v * sy), eye.map((v) => v * sz)];
    const view = [0, 1, 2].flatMap((c) => [rows[0][c], rows[1][c], rows[2][c], 0]).concat(rows.map((row) => -dot(row, middle)), 1);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.32, 0.34, 0.38, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniform("view"), false, view);
    gl.uniform3fv(uniform("low"), low);
    gl.uniform3fv(uniform("size"), size);
    gl.uniform3fv(uniform("ramp"), data.ramp.flat());
    gl.uniform3fv(uniform("eye"), eye);
    gl.uniform1i(uniform("show"), state.show);
    gl.uniform1f(uniform("errorEnd"), data.errorEnd);
    gl.bindVertexArray(shapes[state.pose]);
    gl.drawElements(gl.TRIANGLES, indices.length, gl.UNSIGNED_INT, 0);
  }
  const turn = (right, up) => {
    state.turn -= right;
    state.tilt = Math.min(1.5, Math.max(-1.5, state.tilt + up));
    draw();
  };
  const zoom = (factor) => {
    state.near = Math.min(20, Math.max(0.5, state.near * factor));
    draw();
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons) turn(0.01 * event.movementX, 0.01 * event.movementY);
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-0.001 * event.deltaY));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const keys = { ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1), "+": () => zoom(1.1), "-": () => zoom(1 / 1.1) };
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  for (const button of document.querySelectorAll("[data-show]"))
    button.addEventListener("click", () => {
      for (const other of document.querySelectorAll("[data-show]")) other.setAttribute("aria-pressed", String(other === button));
      state.show = shows.indexOf(button.dataset.show);
      draw();
    });
  poses.addEventListener("change", () => {
    state.pose = poses.selectedIndex;
    draw();
  });
  new ResizeObserver(draw).observe(canvas);
  draw();
})();
