// node compress.mjs draco|meshopt IN.glb OUT.glb: compresses a file as glTF Transform's command line does.

import { stat } from 'node:fs/promises';
import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { draco, meshopt } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptEncoder } from 'meshoptimizer';

const [kind, from, to] = process.argv.slice(2);
await MeshoptEncoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.encoder': await draco3d.createEncoderModule(),
  'meshopt.encoder': MeshoptEncoder,
});
const document = await io.read(from);
await document.transform({ draco: draco(), meshopt: meshopt({ encoder: MeshoptEncoder, level: 'high' }) }[kind]);
await io.write(to, document);
const [before, after] = [await stat(from), await stat(to)];
console.log(`${from} by ${kind}: ${before.size} bytes became ${after.size}`);
