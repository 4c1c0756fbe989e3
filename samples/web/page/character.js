// The baked data: geometry and clips of the character, and its .nook file.
const types = { float32: Float32Array, uint32: Uint32Array, uint16: Uint16Array, uint8: Uint8Array };

async function fetched(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} cannot be fetched (status ${response.status}); samples/web/build.sh makes it`);
  return response;
}

export async function fetchBytes(url) {
  return (await fetched(url)).arrayBuffer();
}

export async function fetchCharacter(folder) {
  const [description, bytes, nook] = await Promise.all([
    fetched(`${folder}/character.json`).then((response) => response.json()),
    fetchBytes(`${folder}/character.bin`),
    fetchBytes(`${folder}/character.nook`),
  ]);
  const arrays = {};
  for (const [name, { type, offset, length }] of Object.entries(description.arrays)) arrays[name] = new types[type](bytes, offset, length);
  return { ...description, arrays, nook };
}

// The matrices of a clip at a time, 12 floats for each bone, between the two nearest frames.
export function samplePose(character, clip, seconds, out) {
  const { first_frame: first, frames, seconds: length } = character.clips[clip];
  const floats = 12 * character.bones;
  const at = ((((seconds / length) % 1) + 1) % 1) * frames;
  const a = Math.floor(at) % frames, b = (a + 1) % frames, t = at - Math.floor(at);
  const all = character.arrays.frames, from = (first + a) * floats, to = (first + b) * floats;
  for (let i = 0; i < floats; ++i) out[i] = all[from + i] * (1 - t) + all[to + i] * t;
  return out;
}

// The matrices of the frame that the ray-traced reference has.
export function referencePose(character, clip, out) {
  const floats = 12 * character.bones;
  const { first_frame: first, reference_frame: middle } = character.clips[clip];
  out.set(character.arrays.frames.subarray((first + middle) * floats, (first + middle + 1) * floats));
  return out;
}
