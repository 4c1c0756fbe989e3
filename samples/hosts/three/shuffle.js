// Changes the order of a mesh's vertices, as tools that optimise meshes do.
import { BufferGeometry } from "three";

// Gives the mesh a geometry with its vertices in a random order. Vertex i of the new geometry is vertex order[i] of the old
// one. Returns `order`.
export function shuffle(mesh) {
  const { attributes, index } = mesh.geometry;
  const { count } = attributes.position;
  const order = Array.from({ length: count }, (_, i) => i);
  for (let i = count - 1, seed = 1; i > 0; --i) {
    seed = (seed * 48271) % 2147483647;
    const j = seed % (i + 1);
    [order[i], order[j]] = [order[j], order[i]];
  }
  const place = new Uint32Array(count);
  order.forEach((from, to) => (place[from] = to));
  const geometry = new BufferGeometry();
  for (const [name, from] of Object.entries(attributes)) {
    const to = from.clone();
    order.forEach((source, i) => {
      for (let c = 0; c < from.itemSize; ++c) to.setComponent(i, c, from.getComponent(source, c));
    });
    geometry.setAttribute(name, to);
  }
  geometry.setIndex(index ? Array.from(index.array, (vertex) => place[vertex]) : Array.from(place));
  mesh.geometry = geometry;
  return order;
}
