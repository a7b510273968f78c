// SPDX-License-Identifier: Apache-2.0
// usd.mjs FILE: what three's USDLoader and tinyusdz read of a scene, as JSON: for each reader its meshes with names, triangles'
// corners as positions, normals and texture coordinates in the space of the prim, and the matrix to the world.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';

const require = createRequire(import.meta.url);
const bytes = readFileSync(process.argv[2]);

async function byThree() {
  const {USDLoader} = await import('three/examples/jsm/loaders/USDLoader.js');
  const scene = new USDLoader().parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
  scene.updateMatrixWorld(true);
  const meshes = [];
  scene.traverse((object) => {
    if (!object.isMesh) return;
    const {position, normal, uv} = object.geometry.attributes;
    const index = object.geometry.index ? Array.from(object.geometry.index.array) : null;
    const corners = (attribute) => {
      if (!attribute) return [];
      const values = Array.from(attribute.array), n = attribute.itemSize;
      return index ? index.flatMap((i) => values.slice(n * i, n * i + n)) : values;
    };
    meshes.push({name: object.name, positions: corners(position), normals: corners(normal), texture: corners(uv),
                 matrix: object.matrixWorld.elements});
  });
  return meshes;
}

// It is built for browsers alone.
async function byTinyusdz() {
  globalThis.window = globalThis;
  process.type = 'renderer';
  globalThis.document = {currentScript: {src: ''}};
  const path = require.resolve('tinyusdz');
  const {default: start} = await import(path);
  const native = await start({wasmBinary: readFileSync(path.replace('tinyusdz.js', 'tinyusdz.wasm'))});
  const scene = new native.TinyUSDZLoaderNative();
  if (!scene.loadFromBinary(new Uint8Array(bytes), process.argv[2])) throw new Error('tinyusdz: ' + scene.error());
  const meshes = [];
  for (let i = 0; i < scene.numMeshes(); ++i) {
    const mesh = scene.getMesh(i);
    const index = Array.from(mesh.faceVertexIndices);
    const corners = (values, n) => (values ? index.flatMap((k) => Array.from(values.slice(n * k, n * k + n))) : []);
    meshes.push({name: mesh.absPath, positions: corners(mesh.points, 3), normals: corners(mesh.normals, 3),
                 texture: corners(mesh.texcoords, 2)});
  }
  return meshes;
}

const found = {three: await byThree(), tinyusdz: await byTinyusdz()};
process.stdout.write(JSON.stringify(found) + '\n');
process.exit(0);
