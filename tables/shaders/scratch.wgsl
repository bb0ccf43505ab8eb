// Scratches by the table of irido lut scratch. Lengths here are um. u = W q for a scratch of width W,
// q = dot(light + view, b), b the unit vector across it in the surface. Colours are those of the
// table's space; rho is the scratch's share of what is seen, W G / (sqrt(pi) sigma).

// Texture coordinate of x along one axis of a table: its first and last value and its number of
// samples, as the table's metadata gives them.
fn irido_texel(x: f32, axis: vec3f) -> f32 {
    let t = select(0.0, clamp((x - axis.x) / (axis.y - axis.x), 0.0, 1.0), axis.z > 1.0);
    return (0.5 + (axis.z - 1.0) * t) / axis.z;
}

// Place of |u| on the table's first axis: u_axis = (scale, count), scale being the metadata's
// request.u_scale_um and count its number of samples.
fn irido_scratch_place(u_um: f32, u_axis: vec2f) -> f32 {
    let x = abs(u_um) / (abs(u_um) + u_axis.x);
    return min(x + 0.5 / u_axis.y, 1.0 - 0.5 / u_axis.y);
}

// Texture coordinate of a depth along the second axis: depth_axis = (first, last, count, scale), scale
// being the metadata's request.depth_scale_um, or 0 where it has none and depths are equally spaced.
fn irido_scratch_depth(depth_um: f32, depth_axis: vec4f) -> f32 {
    if (depth_axis.w <= 0.0) {
        return irido_texel(depth_um, depth_axis.xyz);
    }
    let ends = depth_axis.xy / (depth_axis.xy + vec2f(depth_axis.w, depth_axis.w));
    return irido_texel(depth_um / (depth_um + depth_axis.w), vec3f(ends, depth_axis.z));
}

// Of a table made with --carrier, whose halves are real and imaginary parts: T(|u|, D) or, with
// --per-place, dT/dx.
fn irido_scratch_of_table(table: texture_2d<f32>, table_sampler: sampler, u_axis: vec2f,
                          depth_axis: vec4f, carrier_um: vec3f, u_um: f32, depth_um: f32) -> vec3f {
    let y = irido_scratch_place(u_um, u_axis);
    let d = 0.5 * irido_scratch_depth(depth_um, depth_axis);
    let level = textureSampleLevel(table, table_sampler,
                                   vec2f(0.5 * irido_scratch_depth(0.0, depth_axis), y), 0.0).rgb;
    let re = textureSampleLevel(table, table_sampler, vec2f(d, y), 0.0).rgb;
    let im = textureSampleLevel(table, table_sampler, vec2f(d + 0.5, y), 0.0).rgb;
    let turn = 6.28318530718 * fract(2.0 * depth_um / carrier_um);
    return 2.0 * (level - re * cos(turn) + im * sin(turn));
}

// Radiance over a light's that covers q0 to q1, times 1/rho: for lights from 0.05 in
// |x1 - x0| up, x = u/(|u| + scale). The table is f32.
fn irido_scratch_wide(table: texture_2d<f32>, table_sampler: sampler, u_axis: vec2f,
                      depth_axis: vec4f, carrier_um: vec3f, width_um: f32, depth_um: f32, q0: f32,
                      q1: f32) -> vec3f {
    let high = irido_scratch_of_table(table, table_sampler, u_axis, depth_axis, carrier_um,
                                      width_um * q1, depth_um);
    let low = irido_scratch_of_table(table, table_sampler, u_axis, depth_axis, carrier_um,
                                     width_um * q0, depth_um);
    return select(high, -high, q1 < 0.0) - select(low, -low, q0 < 0.0);
}

// The same for narrower lights, by a table made with --per-place, which may be f16: two Gauss
// points.
fn irido_scratch_narrow(table: texture_2d<f32>, table_sampler: sampler, u_axis: vec2f,
                        depth_axis: vec4f, carrier_um: vec3f, width_um: f32, depth_um: f32,
                        q0: f32, q1: f32) -> vec3f {
    let u0 = width_um * q0;
    let u1 = width_um * q1;
    let x0 = u0 / (abs(u0) + u_axis.x);
    let x1 = u1 / (abs(u1) + u_axis.x);
    let middle = 0.5 * (x0 + x1);
    let reach = 0.288675135 * (x1 - x0);
    let a = abs(middle - reach);
    let b = abs(middle + reach);
    let low = irido_scratch_of_table(table, table_sampler, u_axis, depth_axis, carrier_um,
                                     u_axis.x * a / (1.0 - a), depth_um);
    let high = irido_scratch_of_table(table, table_sampler, u_axis, depth_axis, carrier_um,
                                      u_axis.x * b / (1.0 - b), depth_um);
    return 0.5 * (x1 - x0) * (low + high);
}

// G by the table of irido lut scratch-footprint: distance of the scratch from the footprint's
// centre and half extent of the footprint across it, um. counts: samples along offset and extent.
fn irido_scratch_footprint(table: texture_2d<f32>, table_sampler: sampler, counts: vec2f,
                           distance_um: f32, half_um: f32, sigma_um: f32) -> f32 {
    let y = abs(distance_um) / (half_um + 3.0 * sigma_um);
    let x = half_um / (half_um + sigma_um);
    let place = (vec2f(0.5) + (counts.yx - vec2f(1.0)) * vec2f(x, min(y, 1.0))) / counts.yx;
    let g = textureSampleLevel(table, table_sampler, place, 0.0).r / (1.0 + half_um / sigma_um);
    return select(g, 0.0, y > 1.0);
}
