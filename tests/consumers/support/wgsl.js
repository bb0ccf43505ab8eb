// In the browser: compiles each job's WGSL by WebGPU and runs it once for every point, beside the same in GLSL
// by WebGL 2 if the job has it. A job:
//   wgsl      code with `fn called(x: f32, y: f32) -> vec4f` or, for points of eight numbers,
//             `fn called_of(a: vec4f, b: vec4f) -> vec4f`, and bindings 0 to 3 of group 0
//   glsl      code with `vec4 called(float x, float y)`, or none
//   points    two numbers each or, without `glsl`, eight, flat
//   table     { url, width, height } of texels of four halves; none: waves
const size = { table: [32, 16], volume: [16, 8, 4] };

/** Halves of numbers in [0.25, 1): smooth along every axis. */
function waves(width, height, depth) {
    const halves = new Uint16Array(4 * width * height * depth);
    for (let i = 0; i < halves.length; ++i) {
        const c = i % 4, x = Math.floor(i / 4) % width, y = Math.floor(i / 4 / width) % height;
        const z = Math.floor(i / 4 / width / height);
        const value = 0.6 + 0.12 * Math.sin(1 + c + 5 * x / width) + 0.12 * Math.cos(c + 3 * y / height)
            + 0.1 * Math.sin(2 * z / depth);
        const exponent = Math.floor(Math.log2(value));
        halves[i] = (exponent + 15 << 10) + Math.round((value / 2 ** exponent - 1) * 1024);
    }
    return halves;
}

const adapter = await navigator.gpu?.requestAdapter();
const device = await adapter?.requestDevice();

function texture(dimension, [width, height, depth = 1], halves) {
    const made = device.createTexture({
        dimension, size: [width, height, depth], format: 'rgba16float',
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    device.queue.writeTexture({ texture: made }, halves, { bytesPerRow: 8 * width, rowsPerImage: height },
        [width, height, depth]);
    return made.createView();
}

async function runWgsl({ wgsl, points, table }, count, each) {
    const halves = table ? new Uint16Array(await (await fetch(table.url)).arrayBuffer()) : waves(...size.table, 1);
    const call = each === 2 ? 'called(points[2u * i], points[2u * i + 1u])'
        : `called_of(vec4f(${[0, 1, 2, 3].map((k) => `points[8u * i + ${k}u]`)}), vec4f(${[4, 5, 6, 7].map((k) => `points[8u * i + ${k}u]`)}))`;
    const module = device.createShaderModule({ code: `${wgsl}
@group(0) @binding(4) var<storage, read> points: array<f32>;
@group(0) @binding(5) var<storage, read_write> results: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x;
    if (i < arrayLength(&results)) { results[i] = ${call}; }
}
` });
    const { messages } = await module.getCompilationInfo();
    const said = messages.map(({ type, lineNum, message }) => `${type} at line ${lineNum}: ${message}`);
    if (said.length) return { said };
    const sampler = device.createSampler({ magFilter: 'linear', minFilter: 'linear' });
    const type = { buffer: { type: 'read-only-storage' } };
    const layout = device.createBindGroupLayout({ entries: [
        { texture: {} }, { sampler: {} }, { texture: { viewDimension: '3d' } }, { sampler: {} }, type,
        { buffer: { type: 'storage' } },
    ].map((entry, binding) => ({ binding, visibility: GPUShaderStage.COMPUTE, ...entry })) });
    const buffer = (bytes, usage) => device.createBuffer({ size: bytes, usage });
    const input = buffer(4 * points.length, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
    device.queue.writeBuffer(input, 0, new Float32Array(points));
    const output = buffer(16 * count, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
    const read = buffer(16 * count, GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST);
    const resources = [
        texture('2d', table ? [table.width, table.height] : size.table, halves), sampler,
        texture('3d', size.volume, waves(...size.volume)), sampler, { buffer: input }, { buffer: output },
    ];
    const pipeline = await device.createComputePipelineAsync({
        layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }), compute: { module },
    });
    const encoder = device.createCommandEncoder(), pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({
        layout, entries: resources.map((resource, binding) => ({ binding, resource })),
    }));
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    encoder.copyBufferToBuffer(output, 0, read, 0, 16 * count);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    return { said, values: Array.from(new Float32Array(read.getMappedRange())) };
}

const gl = document.createElement('canvas').getContext('webgl2');
gl.getExtension('EXT_color_buffer_float');

function glTexture(unit, target, [width, height, depth], data, type) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(target, gl.createTexture());
    const isFloat = type === gl.FLOAT, format = isFloat ? gl.RGBA32F : gl.RGBA16F;
    if (depth) gl.texImage3D(target, 0, format, width, height, depth, 0, gl.RGBA, type, data);
    else gl.texImage2D(target, 0, format, width, height, 0, gl.RGBA, type, data);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(target, filter, isFloat ? gl.NEAREST : gl.LINEAR);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
        gl.texParameteri(target, wrap, gl.CLAMP_TO_EDGE);
}

function runGlsl({ glsl, points }, count) {
    const shader = (type, text) => {
        const made = gl.createShader(type);
        gl.shaderSource(made, text);
        gl.compileShader(made);
        if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
        return made;
    };
    const program = gl.createProgram();
    gl.attachShader(program, shader(gl.VERTEX_SHADER, `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`));
    gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `#version 300 es
precision highp float;
uniform highp sampler2D points;
out vec4 color;
${glsl}
void main() {
    vec2 place = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xy;
    color = called(place.x, place.y);
}`));
    gl.linkProgram(program);
    gl.useProgram(program);
    const texels = new Float32Array(4 * count);
    for (let i = 0; i < count; ++i) texels.set(points.slice(2 * i, 2 * i + 2), 4 * i);
    glTexture(0, gl.TEXTURE_2D, size.table, waves(...size.table, 1), gl.HALF_FLOAT);
    glTexture(1, gl.TEXTURE_3D, size.volume, waves(...size.volume), gl.HALF_FLOAT);
    glTexture(2, gl.TEXTURE_2D, [count, 1], texels, gl.FLOAT);
    ['table', 'volume', 'points'].forEach((name, unit) => gl.uniform1i(gl.getUniformLocation(program, name), unit));
    gl.activeTexture(gl.TEXTURE3);
    const target = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, target);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, count, 1);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
    gl.viewport(0, 0, count, 1);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const values = new Float32Array(4 * count);
    gl.readPixels(0, 0, count, 1, gl.RGBA, gl.FLOAT, values);
    return Array.from(values);
}

const answers = [];
if (device)
    for (const job of await (await fetch('/jobs')).json()) {
        const each = job.table ? 8 : 2, count = job.points.length / each;
        let answer;
        try {
            answer = await runWgsl(job, count, each);
            if (job.glsl) answer.glsl = runGlsl(job, count);
        } catch (error) {
            answer = { error: String(error.stack ?? error) };
        }
        answers.push(answer);
    }
await fetch('/answers', {
    method: 'POST',
    body: JSON.stringify({ adapter: adapter?.info?.architecture ?? adapter?.info?.vendor, hasDevice: !!device, answers }),
});
