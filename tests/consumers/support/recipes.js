// In the browser: spheres in the materials of docs/shaders.md, seen along z and lit from there. Jobs:
//   size, axes (of the table), thicknesses_nm. Answers: linear pixels, for each thickness the film's own
//   material and then the physical one.
import * as THREE from 'three';
import { filmMaterial } from '/tables/film-material.js';
import { iridescentMaterial } from '/tables/iridescent-material.js';

const said = [];
for (const level of ['warn', 'error']) console[level] = (...words) => said.push(words.join(' '));

const { size, axes, thicknesses_nm } = await (await fetch('/jobs')).json();
const axis = ({ first, last, count }) => new THREE.Vector3(first, last, count);
const renderer = new THREE.WebGLRenderer({ antialias: false });
const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
camera.position.z = 5;
const light = new THREE.DirectionalLight(0xffffff, Math.PI);
light.position.z = 5;
const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType, format: THREE.RGBAFormat });
const pixels = [];

function draw(material) {
    const scene = new THREE.Scene();
    scene.add(light, new THREE.Mesh(new THREE.SphereGeometry(1, 512, 256), material));
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const rgba = new Float32Array(4 * size * size);
    renderer.readRenderTargetPixels(target, 0, 0, size, size, rgba);
    pixels.push(Array.from(rgba));
}

for (const thickness_nm of thicknesses_nm) {
    const places = { cosine: axis(axes.cosine), nm: axis(axes.nm) };
    draw(await filmMaterial(renderer, places, thickness_nm));
    draw(await iridescentMaterial(renderer, places, thickness_nm, { metalness: 1, roughness: 0.6 }));
}
await fetch('/answers', { method: 'POST', body: JSON.stringify({ said, pixels }) });
