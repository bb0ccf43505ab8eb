// A call of every function that a snippet is there for. `table` is 2D, `volume` 3D; $x stands for a
// texture as the language passes it.
const axis = 'float3(0.0, 1.0, 8.0)';

export const calls = {
    albedo: [`float4(irido_albedo($table, ${axis}, ${axis}, x, y), 1.0)`],
    bragg: ['float4(irido_bragg(1.0, 100.0, 1.5, 90.0, 20.0, x, 550.0), 0.0, 0.0, 1.0)'],
    color: [
        `float4(irido_color($table, ${axis}, ${axis}, x, y), 1.0)`,
        `float4(irido_color_of_angle($table, ${axis}, x), 1.0)`,
        `float4(irido_color_of_two($volume, ${axis}, ${axis}, ${axis}, x, y, x), 1.0)`,
        `float4(irido_color_of_spread($table, ${axis}, ${axis}, x, y, 0.5), 1.0)`,
    ],
    cumulative: [
        `float4(irido_cumulative($table, ${axis}, x), 1.0)`,
        `float4(irido_box($table, ${axis}, x, y), 1.0)`,
    ],
    falpha: [
        `float4(irido_falpha($table, ${axis}, ${axis}, x, y), 0.0, 0.0, 1.0)`,
        `float4(irido_falpha_volume($volume, ${axis}, ${axis}, ${axis}, 0.1, x, y), 0.0, 0.0, 1.0)`,
    ],
    'falpha-closed': ['float4(irido_falpha_closed(0.2, x, y), 0.0, 0.0, 1.0)'],
    fourier: [
        `float4(irido_film($table, ${axis}, float3(0.0, 0.0, 0.0), float4(0.0, 10.0, 20.0, 40.0), 1.0, 1.33, float2(1.5, 3.0),
            400.0, 5.0, x, 8), 1.0)`,
        `float4(irido_film_real($table, ${axis}, float4(0.0, 0.0, 0.0, 0.0), 1.0, 1.33, 1.5, 400.0, 0.0, x, 8), 1.0)`,
        'float4(irido_film_without_fringes(float3(0.95, 1.0, 1.09), 1.0, 1.33, float2(1.5, 3.0), x), 1.0)',
    ],
    scratch: [
        `float4(irido_scratch_wide($table, float2(2.0, 256.0), float4(0.0, 3.15, 64.0, 1.0), float3(0.575, 0.557, 0.452), 2.0, 0.14, x, y), 1.0)`,
        `float4(irido_scratch_narrow($table, float2(2.0, 256.0), float4(0.0, 3.15, 64.0, 0.0), float3(0.575, 0.557, 0.452), 2.0, 0.14, x, y), 1.0)`,
        'float4(irido_scratch_footprint($table, float2(128.0, 128.0), x, y, 60.0), 0.0, 0.0, 1.0)',
    ],
    'scratch-nodes': [
        'float4(irido_scratch_nodes($table, 33.0, x, y, 0.28), 1.0)',
        'float4(irido_scratch_nodes_slope($table, 33.0, x, y), 1.0)',
        'float4(irido_scratch_nodes_point($table, 33.0, 2.0, float2(0.001 * x, y), 0.28, 60.0), 1.0)',
    ],
    layered: ['two_layers($table, x, y)'],
    sensitivity: [
        `float4(irido_sensitivity_real($table, ${axis}, x, y), 1.0)`,
        `both($table, x, y)`,
    ],
    transmissivity: [
        `float4(irido_transmissivity($table, ${axis}, ${axis}, x, y), 0.0, 0.0, 1.0)`,
        `float4(irido_transmissivity_volume($volume, ${axis}, ${axis}, ${axis}, 0.1, x, y), 0.0, 0.0, 1.0)`,
    ],
};

/** What a call needs beside the snippet. */
export const helpers = {
    layered: {
        glsl: `vec4 two_layers(highp sampler2D table, float x, float y) {
    float alpha[IRIDO_LAYERS];
    for (int layer = 0; layer < IRIDO_LAYERS; ++layer) alpha[layer] = 0.1;
    return vec4(irido_layered(table, ${axis.replace('float3', 'vec3')}, ${axis.replace('float3', 'vec3')}, 4, alpha, 1.0, 1.35,
        normalize(vec3(x, y, 1.0)), normalize(vec3(y, x, 1.0))), 1.0);
}`,
        hlsl: `float4 two_layers(Texture2D table, SamplerState table_sampler, float x, float y) {
    float alpha[IRIDO_LAYERS];
    for (int layer = 0; layer < IRIDO_LAYERS; ++layer) alpha[layer] = 0.1;
    return float4(irido_layered(table, table_sampler, ${axis}, ${axis}, 4, alpha, 1.0, 1.35,
        normalize(float3(x, y, 1.0)), normalize(float3(y, x, 1.0))), 1.0);
}`,
    },
    sensitivity: {
        glsl: `vec4 both(highp sampler2D table, float x, float y) {
    vec3 re, im;
    irido_sensitivity(table, ${axis.replace('float3', 'vec3')}, vec3(0.0), x, y, re, im);
    return vec4(re + im, 1.0);
}`,
        hlsl: `float4 both(Texture2D table, SamplerState table_sampler, float x, float y) {
    float3 re, im;
    irido_sensitivity(table, table_sampler, ${axis}, float3(0.0, 0.0, 0.0), x, y, re, im);
    return float4(re + im, 1.0);
}`,
    },
};

/** A whole fragment shader around a snippet. version: of GLSL, as its first line says. */
export function glslProgram(name, source, version) {
    const sum = calls[name].map((call) => call.replace(/\$/g, '').replace(/float(\d)/g, 'vec$1')).join(' + ');
    return `#version ${version}
precision highp float;
uniform sampler2D table;
uniform highp sampler3D volume;
in vec2 place;
out vec4 color;
${source}
${helpers[name]?.glsl ?? ''}
void main() {
    float x = place.x, y = place.y;
    color = ${sum};
}
`;
}

export function hlslProgram(name, source) {
    const sum = calls[name].map((call) => call.replace(/\$(\w+)/g, '$1, $1_sampler')).join(' + ');
    return `Texture2D table : register(t0);
SamplerState table_sampler : register(s0);
Texture3D volume : register(t1);
SamplerState volume_sampler : register(s1);
${source}
${helpers[name]?.hlsl ?? ''}
float4 main(float2 place : TEXCOORD0) : SV_Target {
    float x = place.x, y = place.y;
    return ${sum};
}
`;
}
