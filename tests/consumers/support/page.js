// In the browser: loads the textures of each job with three.js, runs its shader once for every point,
// and sends back what came out. A job:
//   name      of the job
//   tables    { uniform: URL of a KTX2 file }
//   source    GLSL before the function
//   result    body of `vec4 result(vec4 a, vec4 b)`, a and b being a point's eight numbers
//   points    eight numbers each, flat
import * as THREE from 'three';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';

const width = 64;
const renderer = new THREE.WebGLRenderer({ antialias: false });
const loader = new KTX2Loader().detectSupport(renderer);
const camera = new THREE.Camera();
const triangle = new THREE.BufferGeometry();
triangle.setAttribute('position', new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));

const said = [];
for (const level of ['warn', 'error']) console[level] = (...words) => said.push(words.join(' '));

async function load(url) {
    const texture = await loader.loadAsync(url);
    const found = {
        volume: texture.isData3DTexture === true,
        width: texture.image.width,
        height: texture.image.height,
        depth: texture.image.depth ?? 0,
        levels: texture.mipmaps.length,
        colorSpace: texture.colorSpace,
    };
    // the loader leaves the nearest texel and a space that three may not know
    texture.magFilter = THREE.LinearFilter;
    texture.minFilter = texture.mipmaps.length > 1 ? THREE.LinearMipmapNearestFilter : THREE.LinearFilter;
    texture.colorSpace = THREE.NoColorSpace;
    return { texture, found };
}

function pointTextures(points) {
    const count = points.length / 8, height = Math.ceil(count / width);
    const halves = [0, 4].map((first) => {
        const data = new Float32Array(4 * width * height);
        for (let i = 0; i < count; ++i) data.set(points.slice(8 * i + first, 8 * i + first + 4), 4 * i);
        const texture = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.FloatType);
        texture.needsUpdate = true;
        return texture;
    });
    return { halves, count, height };
}

async function run({ tables = {}, source = '', result, points }) {
    const uniforms = {}, found = {};
    let declarations = '';
    for (const [name, url] of Object.entries(tables)) {
        const loaded = await load(url);
        found[name] = loaded.found;
        uniforms[name] = { value: loaded.texture };
        declarations += `uniform highp sampler${loaded.found.volume ? 3 : 2}D ${name};\n`;
    }
    const { halves, count, height } = pointTextures(points);
    uniforms.irido_test_a = { value: halves[0] };
    uniforms.irido_test_b = { value: halves[1] };
    const material = new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3,
        uniforms,
        vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position, 1.0); }',
        fragmentShader: `precision highp float;
precision highp int;
uniform highp sampler2D irido_test_a, irido_test_b;
out vec4 irido_test_out;
${declarations}${source}
vec4 result(vec4 a, vec4 b) {
${result}
}
void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    irido_test_out = result(texelFetch(irido_test_a, place, 0), texelFetch(irido_test_b, place, 0));
}
`,
        depthTest: false,
        depthWrite: false,
    });
    const scene = new THREE.Scene();
    const mesh = new THREE.Mesh(triangle, material);
    mesh.frustumCulled = false;
    scene.add(mesh);
    const target = new THREE.WebGLRenderTarget(width, height, {
        type: THREE.FloatType, format: THREE.RGBAFormat, depthBuffer: false,
        minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter,
    });
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const pixels = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    for (const item of [target, material, ...Object.values(uniforms).map((u) => u.value)]) item.dispose();
    return { found, values: Array.from(pixels.subarray(0, 4 * count)) };
}

const answers = [];
for (const job of await (await fetch('/jobs')).json()) {
    said.length = 0;
    let answer = {};
    try {
        answer = await run(job);
    } catch (error) {
        answer = { error: String(error.stack ?? error) };
    }
    answers.push({ name: job.name, said: [...said], ...answer });
}
const gl = renderer.getContext();
await fetch('/answers', {
    method: 'POST',
    body: JSON.stringify({ version: gl.getParameter(gl.VERSION), answers }),
});
