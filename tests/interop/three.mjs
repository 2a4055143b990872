// node three.mjs BAKED.glb PICTURE.png CAMERA OUT.png: draws the file with three.js in headless Chromium and compares it
// with our picture from the same camera, at the exposure in the file. Fails if they differ by more than the tolerance.
// The light is in vertex colours, or in a texture that the loader reads by the plugin below (MOZ_lightmap).
//
// Programs differ in how they filter textures and smooth edges, which is not tested here. Both pictures are therefore
// drawn large, so that textures show in full, and the means of squares of SHRINK x SHRINK pixels are compared.

import { createServer } from 'node:http';
import { readFile, writeFile } from 'node:fs/promises';
import { PNG } from 'pngjs';
import puppeteer from 'puppeteer-core';

const SHRINK = 4;

// Tolerances in sRGB steps of 255: mean difference, and share of squares that differ by more than LARGE in a channel.
// The file stores light that is tone-mapped before it is multiplied by the texture; our picture is tone-mapped after it.
// Both are alike up to the shoulder of the tone map (0.76, an sRGB value of 226). Brighter squares, for example a patch of
// sun on dark wood, cannot be stored, because no unlit surface is brighter than its texture. They are left out; their
// share is printed and bounded.
const MEAN = 1.5;
const LARGE = 24;
const LARGE_SHARE = 0.015;
const ROLL_OFF = 226;
const BRIGHT_SHARE = 0.05;

const [baked, picture, cameraName, out] = process.argv.slice(2);
const ours = PNG.sync.read(await readFile(picture));

const page = `<!doctype html><script type="importmap">{"imports": {"three": "/three/build/three.module.js",
  "three/addons/": "/three/examples/jsm/"}}</script><body style="margin:0"><script type="module">
  import * as THREE from 'three';
  import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(${ours.width}, ${ours.height});
  renderer.toneMapping = THREE.NoToneMapping;
  const lightmaps = (parser) => ({
    name: 'MOZ_lightmap',
    async extendMaterialParams(index, params) {
      const lightmap = parser.json.materials[index].extensions?.MOZ_lightmap;
      if (!lightmap) return;
      params.lightMap = await parser.getDependency('texture', lightmap.index);
      params.lightMap.channel = lightmap.texCoord;
      params.lightMapIntensity = lightmap.intensity;
    },
  });
  const gltf = await new GLTFLoader().register(lightmaps).loadAsync('/scene.glb');
  const scene = new THREE.Scene().add(gltf.scene);
  scene.background = new THREE.Color().setRGB(0.02, 0.02, 0.02);
  const camera = gltf.cameras.find((camera) => [camera.name, camera.parent.name].includes(
    THREE.PropertyBinding.sanitizeNodeName(${JSON.stringify(cameraName)}))) ?? gltf.cameras[0];
  camera.aspect = ${ours.width / ours.height};
  camera.far = 1000;
  camera.updateProjectionMatrix();
  renderer.render(scene, camera);
  const picture = renderer.domElement.toDataURL('image/png');
  scene.traverse((mesh) => {
    if (!mesh.isMesh) return;
    const { map, side, lightMap } = mesh.material;
    if (lightMap) return; // What is too bright is what is shown: no tone map came before the paint.
    mesh.material = new THREE.MeshBasicMaterial({ vertexColors: true, side, color: map ? 0xffffff : 0x000000 });
  });
  renderer.render(scene, camera);
  window.pictures = [picture, renderer.domElement.toDataURL('image/png')];
</script>`;

const kinds = { js: 'text/javascript', glb: 'model/gltf-binary' };
const server = createServer(async ({ url }, response) => {
  try {
    if (url === '/') return response.setHeader('content-type', 'text/html').end(page);
    if (url === '/favicon.ico') return response.writeHead(204).end();
    const file = url === '/scene.glb' ? baked : new URL(`node_modules${url}`, import.meta.url).pathname;
    response.setHeader('content-type', kinds[url.split('.').pop()] ?? 'application/octet-stream').end(await readFile(file));
  } catch {
    response.writeHead(404).end();
  }
}).listen(0, '127.0.0.1');
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
const tab = await browser.newPage();
tab.on('pageerror', (error) => console.error(error.message));
tab.on('console', (message) => message.type() === 'error' && console.error(message.text()));
await tab.goto(`http://127.0.0.1:${server.address().port}/`);
await tab.waitForFunction('window.pictures', { timeout: 120000 });
const pictures = await tab.evaluate('window.pictures');
await browser.close();
server.close();

const bytes = pictures.map((url) => Buffer.from(url.split(',')[1], 'base64'));
await writeFile(out, bytes[0]);
const [theirs, brightness] = bytes.map((picture) => PNG.sync.read(picture));
const [width, height] = [Math.floor(ours.width / SHRINK), Math.floor(ours.height / SHRINK)];
/// Mean of a channel over a square.
function shown({ data }, x, y, channel) {
  let sum = 0;
  for (let row = y * SHRINK; row < (y + 1) * SHRINK; row++) {
    for (let column = x * SHRINK; column < (x + 1) * SHRINK; column++) sum += data[4 * (row * ours.width + column) + channel];
  }
  return sum / SHRINK ** 2;
}
let [sum, large, bright, compared] = [0, 0, 0, 0];
for (let y = 0; y < height; y++) {
  for (let x = 0; x < width; x++) {
    if ([0, 1, 2].some((c) => shown(brightness, x, y, c) > ROLL_OFF)) {
      bright += 1;
      continue;
    }
    compared += 1;
    const differences = [0, 1, 2].map((c) => Math.abs(shown(ours, x, y, c) - shown(theirs, x, y, c)));
    sum += (differences[0] + differences[1] + differences[2]) / 3;
    large += Math.max(...differences) > LARGE;
  }
}
const [mean, share, brightShare] = [sum / compared, large / compared, bright / (bright + compared)];
const percent = (x) => `${(100 * x).toFixed(2)} %`;
console.log(`${baked} in three.js: mean difference ${mean.toFixed(2)} of 255 (at most ${MEAN}), ${percent(share)} of squares by more than ${LARGE} (at most ${percent(LARGE_SHARE)}), ${percent(brightShare)} too bright for it (at most ${percent(BRIGHT_SHARE)})`);
process.exit(mean <= MEAN && share <= LARGE_SHARE && brightShare <= BRIGHT_SHARE ? 0 : 1);
