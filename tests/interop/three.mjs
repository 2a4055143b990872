// node three.mjs BAKED.glb PICTURE.png CAMERA OUT.png: the file in three.js, in headless Chromium, beside our own picture
// through the same camera at the exposure that the file states. Fails where they differ by more than the tolerance.

import { createServer } from 'node:http';
import { readFile, writeFile } from 'node:fs/promises';
import { PNG } from 'pngjs';
import puppeteer from 'puppeteer-core';

// sRGB steps of 255: mean difference, and share of pixels that differ by more than LARGE in a channel. Edges and textures are
// sampled elsewhere by each program, ours are dithered by half a step, and no unlit surface can be brighter than its
// texture, as a patch of sun may be.
const MEAN = 2;
const LARGE = 24;
const LARGE_SHARE = 0.03;

const [baked, picture, cameraName, out] = process.argv.slice(2);
const ours = PNG.sync.read(await readFile(picture));

const page = `<!doctype html><script type="importmap">{"imports": {"three": "/three/build/three.module.js",
  "three/addons/": "/three/examples/jsm/"}}</script><body style="margin:0"><script type="module">
  import * as THREE from 'three';
  import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(${ours.width}, ${ours.height});
  renderer.toneMapping = THREE.NoToneMapping;
  const gltf = await new GLTFLoader().loadAsync('/scene.glb');
  const scene = new THREE.Scene().add(gltf.scene);
  scene.background = new THREE.Color().setRGB(0.02, 0.02, 0.02);
  const camera = gltf.cameras.find((camera) => [camera.name, camera.parent.name].includes(
    THREE.PropertyBinding.sanitizeNodeName(${JSON.stringify(cameraName)}))) ?? gltf.cameras[0];
  camera.aspect = ${ours.width / ours.height};
  camera.far = 1000;
  camera.updateProjectionMatrix();
  renderer.render(scene, camera);
  window.picture = renderer.domElement.toDataURL('image/png');
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
await tab.waitForFunction('window.picture', { timeout: 120000 });
const url = await tab.evaluate('window.picture');
await browser.close();
server.close();

const bytes = Buffer.from(url.split(',')[1], 'base64');
await writeFile(out, bytes);
const theirs = PNG.sync.read(bytes);
let [sum, large] = [0, 0];
for (let i = 0; i < ours.data.length; i += 4) {
  const differences = [0, 1, 2].map((c) => Math.abs(ours.data[i + c] - theirs.data[i + c]));
  sum += (differences[0] + differences[1] + differences[2]) / 3;
  large += Math.max(...differences) > LARGE;
}
const pixels = ours.width * ours.height;
const [mean, share] = [sum / pixels, large / pixels];
console.log(`${baked} in three.js: mean difference ${mean.toFixed(2)} of 255 (at most ${MEAN}), ${(100 * share).toFixed(2)} % of pixels by more than ${LARGE} (at most ${100 * LARGE_SHARE} %)`);
process.exit(mean <= MEAN && share <= LARGE_SHARE ? 0 : 1);
