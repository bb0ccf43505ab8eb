// In the browser: draws spheres of a baked scene's materials under a white sky, from its manifest.json
// and the snippets that it names alone. The jobs: { size, materials, snippets: { name: GLSL } }.
// What varies goes from its first value at the bottom of a sphere to its last at the top.
import * as THREE from 'three';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';

const said = [];
for (const level of ['warn', 'error']) console[level] = (...words) => said.push(words.join(' '));

const { size, materials, snippets } = await (await fetch('/jobs')).json();
const manifest = await (await fetch('/tables/manifest.json')).json();
const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
renderer.setSize(size * materials.length, size, false);
document.body.append(renderer.domElement);
const loader = new KTX2Loader().detectSupport(renderer);

const axis = ({ first, last, count }) => new THREE.Vector3(first, last, count);

/** What a material's tables, constants and snippets come to: GLSL of `vec3 shade(float cosine, float t)`, uniforms. */
async function shading(name) {
    const material = manifest.materials[name], uniforms = {};
    let declarations = '', body;
    for (const id of Object.values(material.tables)) {
        const texture = await loader.loadAsync('/tables/' + manifest.tables[id].file);
        texture.magFilter = THREE.LinearFilter;
        texture.minFilter = texture.mipmaps.length > 1 ? THREE.LinearMipmapNearestFilter : THREE.LinearFilter;
        texture.colorSpace = THREE.NoColorSpace;
        uniforms[Object.keys(material.tables).find((role) => material.tables[role] === id)] = { value: texture };
    }
    for (const role of Object.keys(uniforms)) declarations += `uniform highp sampler2D ${role};\n`;
    if (material.shading === 'color') {
        const axes = manifest.tables[material.tables.reflection].axes;
        const angle = axes.findIndex(({ name: axisName }) => axisName === 'cos_theta');
        uniforms.angle_axis = { value: axis(axes[angle]) };
        declarations += 'uniform vec3 angle_axis, value_axis;\n';
        uniforms.value_axis = { value: axes[angle + 1] ? axis(axes[angle + 1]) : new THREE.Vector3() };
        // the axis may end before what varies does: from there on nothing changes
        const [first, last] = axes[angle + 1] ? material.vary[axes[angle + 1].name] : [0, 0];
        uniforms.ends = { value: new THREE.Vector2(first, last) };
        declarations += 'uniform vec2 ends;\n';
        const value = 'mix(ends.x, ends.y, t)';
        body = !axes[angle + 1] ? 'return irido_color_of_angle(reflection, angle_axis, cosine);'
            : angle > 0 ? `return irido_color_of_spread(reflection, angle_axis, value_axis, cosine, ${value}, 0.0);`
                : `return irido_color(reflection, angle_axis, value_axis, cosine, ${value});`;
    } else if (material.shading === 'fourier') {
        const { n1, n2, n3, thickness_nm: thickness, orders, level_sigma_nm: levels } = material.constants;
        const table = manifest.tables[material.tables.sensitivity];
        const { rgb_from_xyz: rgb } = manifest.settings;
        const [first, last] = material.vary?.['layers.0.thickness_nm'] ?? [thickness, thickness];
        Object.assign(uniforms, {
            opd_axis: { value: axis(table.axes[1]) },
            carrier_nm: { value: new THREE.Vector3(...(table.request.carrier_nm ?? [0, 0, 0])) },
            levels: { value: new THREE.Vector4(...levels) },
            indices: { value: new THREE.Vector4(n1, n2, ...n3) },
            thickness_nm: { value: new THREE.Vector2(first, last) },
            orders: { value: orders },
            rgb_from_xyz: { value: new THREE.Matrix3().set(...rgb.flat()) },
        });
        declarations += `uniform vec3 opd_axis, carrier_nm;
uniform vec4 levels, indices;
uniform vec2 thickness_nm;
uniform int orders;
uniform mat3 rgb_from_xyz;
`;
        const film = table.channels.length === 3
            ? 'irido_film_real(sensitivity, opd_axis, levels, indices.x, indices.y, indices.z, d, 0.0, cosine, orders)'
            : `irido_film(sensitivity, opd_axis, carrier_nm, levels, indices.x, indices.y, indices.zw, d, 0.0, cosine, orders)`;
        body = `float d = mix(thickness_nm.x, thickness_nm.y, t);
    return rgb_from_xyz * ${film};`;
    }
    const source = material.snippets.map((snippet) => snippets[snippet]).join('\n');
    return { uniforms, source: `${declarations}${source}\nvec3 shade(float cosine, float t) {\n    ${body}\n}\n` };
}

const scene = new THREE.Scene();
const camera = new THREE.OrthographicCamera(-1, 2 * materials.length - 1, 1, -1, 0, 10);
camera.position.z = 5;
for (const [i, name] of materials.entries()) {
    const { uniforms, source } = await shading(name);
    const mesh = new THREE.Mesh(new THREE.SphereGeometry(0.95, 512, 256), new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3,
        uniforms,
        vertexShader: `in vec3 position, normal;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform mat3 normalMatrix;
out vec3 n;
void main() {
    n = normalMatrix * normal;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,
        fragmentShader: `precision highp float;
precision highp int;
in vec3 n;
out vec4 color;
${source}
void main() {
    vec3 unit = normalize(n);
    vec3 rgb = clamp(shade(unit.z, 0.5 + 0.5 * unit.y), 0.0, 1.0);
    color = vec4(mix(12.92 * rgb, 1.055 * pow(rgb, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, rgb)), 1.0);
}`,
    }));
    mesh.position.x = 2 * i;
    scene.add(mesh);
}
renderer.render(scene, camera);
const gl = renderer.getContext();
const pixels = new Uint8Array(4 * size * size * materials.length);
gl.readPixels(0, 0, size * materials.length, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
await fetch('/answers', {
    method: 'POST',
    body: JSON.stringify({ version: gl.getParameter(gl.VERSION), said, pixels: Array.from(pixels) }),
});
