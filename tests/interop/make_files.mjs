// Writes tests/files/*.glb: a small scene in plain glTF 2.0, and the same scene with each extension that is read.
//
// node make_files.mjs small writes a coarser set to fuzz/small, the first input of the fuzzers.
//
// The encoders are those of glTF Transform, Draco, meshoptimizer, sharp and Basis Universal. tests/scene/twins.rs loads every
// file and compares it with its plain twin.

import { writeFile } from 'node:fs/promises';

import { Accessor, Document, NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS, EXTMeshGPUInstancing, KHRLightsPunctual, KHRMaterialsVariants } from '@gltf-transform/extensions';
import { draco, meshopt, quantize, textureCompress } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { ktx2 } from 'ktx2-encoder/gltf-transform';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';
import sharp from 'sharp';

const isSmall = process.argv[2] === 'small';
const folder = new URL(isSmall ? '../../fuzz/small/' : '../files/', import.meta.url).pathname;
const [columns, rows] = isSmall ? [5, 3] : [16, 10];
const pixelsAcross = isSmall ? 8 : 64;
await MeshoptEncoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.encoder': await draco3d.createEncoderModule(),
  'draco3d.decoder': await draco3d.createDecoderModule(),
  'meshopt.encoder': MeshoptEncoder,
  'meshopt.decoder': MeshoptDecoder,
});

/// Builds a smooth ball of columns x rows quadrilaterals, with texture coordinates and vertex colours.
function ball(document, radius = 1) {
  const [positions, normals, uv, colours, indices] = [[], [], [], [], []];
  for (let j = 0; j <= rows; j++) {
    for (let i = 0; i <= columns; i++) {
      const [u, v] = [i / columns, j / rows];
      const [theta, phi] = [v * Math.PI, u * 2 * Math.PI];
      const n = [Math.sin(theta) * Math.cos(phi), Math.cos(theta), -Math.sin(theta) * Math.sin(phi)];
      positions.push(...n.map((x) => x * radius));
      normals.push(...n);
      uv.push(u, v);
      colours.push(1, 1 - 0.5 * v, 1 - 0.25 * u, 1);
    }
  }
  const at = (i, j) => j * (columns + 1) + i;
  for (let j = 0; j < rows; j++) {
    for (let i = 0; i < columns; i++) {
      if (j > 0) indices.push(at(i, j), at(i, j + 1), at(i + 1, j));
      if (j < rows - 1) indices.push(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  }
  const buffer = document.getRoot().listBuffers()[0];
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  return document.createPrimitive()
    .setAttribute('POSITION', accessor(Accessor.Type.VEC3, new Float32Array(positions)))
    .setAttribute('NORMAL', accessor(Accessor.Type.VEC3, new Float32Array(normals)))
    .setAttribute('TEXCOORD_0', accessor(Accessor.Type.VEC2, new Float32Array(uv)))
    .setAttribute('COLOR_0', accessor(Accessor.Type.VEC4, new Float32Array(colours)))
    .setIndices(accessor(Accessor.Type.SCALAR, new Uint16Array(indices)));
}

/// Draws smooth gradients of colour, as in photographs.
async function picture() {
  const size = pixelsAcross;
  const pixels = Buffer.alloc(size * size * 3);
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) {
      const wave = (a, b) => Math.round(150 + 70 * Math.sin(2 * Math.PI * (a * x + b * y) / size));
      pixels.set([wave(1, 0), wave(1, 1), wave(0, 2)], 3 * (y * size + x));
    }
  }
  return new Uint8Array(await sharp(pixels, { raw: { width: size, height: size, channels: 3 } }).png().toBuffer());
}

/// Adds a camera with the ball in all its positions in view.
function addCamera(document, scene, distance) {
  const camera = document.createCamera('view').setType('perspective').setYFov(0.8).setZNear(0.1).setAspectRatio(1);
  scene.addChild(document.createNode('view').setCamera(camera).setTranslation([0, 0, distance]));
}

async function plain() {
  const document = new Document();
  document.createBuffer();
  const texture = document.createTexture('hills').setImage(await picture()).setMimeType('image/png');
  const material = document.createMaterial('hills').setBaseColorTexture(texture).setMetallicFactor(0).setRoughnessFactor(1);
  const mesh = document.createMesh('ball').addPrimitive(ball(document).setMaterial(material));
  const scene = document.createScene('scene');
  scene.addChild(document.createNode('ball').setMesh(mesh).setRotation([0, 0, Math.sin(0.2), Math.cos(0.2)]));
  addCamera(document, scene, 4);
  return document;
}

async function write(name, document) {
  await io.write(`${folder}${name}.glb`, document);
}

await write('plain', await plain());

const transforms = {
  quantized: [quantize()],
  meshopt: [meshopt({ encoder: MeshoptEncoder, level: 'medium' })],
  meshopt_filters: [meshopt({ encoder: MeshoptEncoder, level: 'high' })],
  draco: [draco({ method: 'edgebreaker' })],
  draco_sequential: [draco({ method: 'sequential' })],
  webp: [textureCompress({ encoder: sharp, targetFormat: 'webp', quality: 90 })],
};
for (const [name, steps] of Object.entries(transforms)) {
  const document = await plain();
  await document.transform(...steps);
  await write(name, document);
}

const imageDecoder = async (bytes) => {
  const { data, info } = await sharp(bytes).ensureAlpha().raw().toBuffer({ resolveWithObject: true });
  return { data: new Uint8Array(data), width: info.width, height: info.height };
};
for (const [name, isUASTC] of [['basisu_uastc', true], ['basisu_etc1s', false]]) {
  const document = await plain();
  const options = { isUASTC, needSupercompression: isUASTC, qualityLevel: 255, isPerceptual: true, isSetKTX2SRGBTransferFunc: true };
  await document.transform(ktx2({ ...options, generateMipmap: true, imageDecoder }));
  await write(name, document);
}

// Indices and colours of every width.
for (const [name, Indices, Colours, largest] of [['bytes', Uint8Array, Uint8Array, 255], ['words', Uint32Array, Uint16Array, 65535]]) {
  const document = await plain();
  const primitive = document.getRoot().listMeshes()[0].listPrimitives()[0];
  const indices = primitive.getIndices();
  indices.setArray(new Indices(indices.getArray()));
  const colours = primitive.getAttribute('COLOR_0');
  colours.setNormalized(true).setArray(Colours.from(colours.getArray(), (x) => Math.round(x * largest)));
  await write(name, document);
}

// Sparse accessor: positions are zero except for the listed rows. Every row is listed.
{
  const document = await plain();
  document.getRoot().listMeshes()[0].listPrimitives()[0].getAttribute('POSITION').setSparse(true);
  await write('sparse', document);
}

// The texture uses the second set of coordinates.
{
  const document = await plain();
  const primitive = document.getRoot().listMeshes()[0].listPrimitives()[0];
  const uv = primitive.getAttribute('TEXCOORD_0');
  primitive.setAttribute('TEXCOORD_1', uv).setAttribute('TEXCOORD_0', uv.clone().setArray(new Float32Array(uv.getArray().length)));
  document.getRoot().listMaterials()[0].getBaseColorTextureInfo().setTexCoord(1);
  await write('second_uv', document);
}

// Morph target: a ball of half the size, with a target that enlarges it to full size.
{
  const document = await plain();
  const mesh = document.getRoot().listMeshes()[0].setWeights([1]);
  const primitive = mesh.listPrimitives()[0];
  const positions = primitive.getAttribute('POSITION');
  const half = positions.clone().setArray(positions.getArray().map((x) => x / 2));
  primitive.setAttribute('POSITION', half);
  primitive.addTarget(document.createPrimitiveTarget().setAttribute('POSITION', half.clone()));
  await write('morph', document);
}

// Skin: the joints have the transform of the node. The node itself has another one.
{
  const document = await plain();
  const root = document.getRoot();
  const node = root.listNodes()[0];
  const primitive = root.listMeshes()[0].listPrimitives()[0];
  const count = primitive.getAttribute('POSITION').getCount();
  const buffer = root.listBuffers()[0];
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const weights = new Float32Array(4 * count);
  const joints = new Uint8Array(4 * count);
  for (let v = 0; v < count; v++) {
    weights.set([0.25, 0.75, 0, 0], 4 * v);
    joints.set([0, 1, 0, 0], 4 * v);
  }
  primitive.setAttribute('JOINTS_0', accessor(Accessor.Type.VEC4, joints));
  primitive.setAttribute('WEIGHTS_0', accessor(Accessor.Type.VEC4, weights));
  const hip = document.createNode('hip').setRotation(node.getRotation());
  const head = document.createNode('head').setTranslation([0, 3, 0]);
  hip.addChild(head);
  const matrices = new Float32Array(32);
  for (const j of [0, 1]) for (const i of [0, 5, 10, 15]) matrices[16 * j + i] = 1;
  matrices[16 + 13] = -3;
  const skin = document.createSkin().addJoint(hip).addJoint(head);
  skin.setInverseBindMatrices(accessor(Accessor.Type.MAT4, matrices));
  node.setSkin(skin).setTranslation([7, 0, 0]).setRotation([0, 0, 0, 1]);
  root.listScenes()[0].addChild(hip);
  await write('skin', document);
}

// Several copies: nodes in the plain twin, instances in the other file.
async function several(instanced) {
  const document = await plain();
  const root = document.getRoot();
  const [scene, node, mesh] = [root.listScenes()[0], root.listNodes()[0], root.listMeshes()[0]];
  const places = [-1.1, 0, 1.1].map((x, i) => ({ translation: [x, 0.3 * i, 0], rotation: [0, Math.sin(i), 0, Math.cos(i)], scale: 0.4 + 0.1 * i }));
  node.setMesh(null).setRotation([0, 0, 0, 1]);
  if (instanced) {
    const buffer = root.listBuffers()[0];
    const accessor = (type, values) =>
      document.createAccessor().setType(type).setArray(new Float32Array(values.flat())).setBuffer(buffer);
    const batch = document.createExtension(EXTMeshGPUInstancing).createInstancedMesh()
      .setAttribute('TRANSLATION', accessor(Accessor.Type.VEC3, places.map((p) => p.translation)))
      .setAttribute('ROTATION', accessor(Accessor.Type.VEC4, places.map((p) => p.rotation)))
      .setAttribute('SCALE', accessor(Accessor.Type.VEC3, places.map((p) => [p.scale, p.scale, p.scale])));
    node.setMesh(mesh).setExtension('EXT_mesh_gpu_instancing', batch);
  } else {
    for (const p of places) {
      node.addChild(document.createNode('ball').setMesh(mesh).setTranslation(p.translation).setRotation(p.rotation).setScale([p.scale, p.scale, p.scale]));
    }
  }
  return document;
}
await write('several_plain', await several(false));
await write('instancing', await several(true));

// Material variant: plain in the variant "hills", bare without a variant.
{
  const document = await plain();
  const root = document.getRoot();
  const primitive = root.listMeshes()[0].listPrimitives()[0];
  const hills = primitive.getMaterial();
  const variants = document.createExtension(KHRMaterialsVariants);
  const variant = variants.createVariant('hills');
  const mapping = variants.createMapping().setMaterial(hills).addVariant(variant);
  primitive.setExtension('KHR_materials_variants', variants.createMappingList().addMapping(mapping));
  primitive.setMaterial(document.createMaterial('bare').setBaseColorFactor([0.1, 0.1, 0.1, 1]).setMetallicFactor(0));
  await write('variants', document);
}

// A second scene, which contains only the camera.
{
  const document = await plain();
  addCamera(document, document.createScene('empty'), 4);
  await write('two_scenes', document);
}

// A point light, and one from a photometric file: 40 candela in every direction.
async function lit() {
  const document = await plain();
  const lamp = document.createNode('lamp').setTranslation([1, 3, 2]).setRotation([0.6, 0, 0, 0.8]);
  document.getRoot().listScenes()[0].addChild(lamp);
  return { document, lamp };
}
{
  const { document, lamp } = await lit();
  const light = document.createExtension(KHRLightsPunctual).createLight('lamp').setType('point').setIntensity(40).setColor([1, 0.5, 0.25]);
  lamp.setExtension('KHR_lights_punctual', light);
  await write('point_light', document);
}
{
  // glTF Transform does not support the extension, so its JSON is added to the file.
  const { document } = await lit();
  const glb = Buffer.from(await io.writeBinary(document));
  const length = glb.readUInt32LE(12);
  const json = JSON.parse(glb.subarray(20, 20 + length).toString());
  const table = 'IES:LM-63-2019\nTILT=NONE\n1 -1 2 3 2 1 2 0 0 0\n1 1 10\n0 90 180\n0 90\n20 20 20\n20 20 20\n';
  const uri = `data:application/x-ies-lm-63;base64,${Buffer.from(table).toString('base64')}`;
  json.extensionsUsed = ['EXT_lights_ies'];
  json.extensions = { EXT_lights_ies: { lights: [{ name: 'lamp', uri }] } };
  const lamp = json.nodes.find(({ name }) => name === 'lamp');
  lamp.extensions = { EXT_lights_ies: { light: 0, color: [1, 0.5, 0.25] } };
  let text = Buffer.from(JSON.stringify(json));
  text = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, ' ')]);
  const head = Buffer.from(glb.subarray(0, 20));
  head.writeUInt32LE(text.length, 12);
  head.writeUInt32LE(glb.length + text.length - length, 8);
  await writeFile(`${folder}photometric_light.glb`, Buffer.concat([head, text, glb.subarray(20 + length)]));
}
