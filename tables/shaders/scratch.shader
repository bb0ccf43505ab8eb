//! use: common
// Scratches by the table of irido lut scratch. Lengths here are um. u = W q for a scratch of width W,
// q = dot(light + view, b), b the unit vector across it in the surface. Colours are those of the
// table's space; rho is the scratch's share of what is seen, W G / (sqrt(pi) sigma).

// Places of |u| on the table's first axis: u_axis = (scale, count), scale being the metadata's
// request.u_scale_um and count its number of samples.
float irido_scratch_place(float u_um, float2 u_axis)
{
    float x = abs(u_um) / (abs(u_um) + u_axis.x);
    return min(x + 0.5 / u_axis.y, 1.0 - 0.5 / u_axis.y);
}

// Texture coordinate of a depth along the second axis: depth_axis = (first, last, count, scale), scale
// being the metadata's request.depth_scale_um, or 0 where it has none and depths are equally spaced.
float irido_scratch_depth(float depth_um, float4 depth_axis)
{
    if (depth_axis.w <= 0.0) { return irido_texel(depth_um, depth_axis.xyz); }
    float2 ends = depth_axis.xy / (depth_axis.xy + float2(depth_axis.w, depth_axis.w));
    return irido_texel(depth_um / (depth_um + depth_axis.w), float3(ends, depth_axis.z));
}

// What |d|^2 = 2 - 2 cos makes of Q at depth 0 and at the depth itself: of a table made with
// --carrier, whose halves are real and imaginary parts, T(|u|, D) or, with --per-place, dT/dx.
float3 irido_scratch_of_table(TEXTURE2D(table), float2 u_axis, float4 depth_axis, float3 carrier_um,
                              float u_um, float depth_um)
{
    float y = irido_scratch_place(u_um, u_axis);
    float d = 0.5 * irido_scratch_depth(depth_um, depth_axis);
    float3 level = SAMPLE2D(table, float2(0.5 * irido_scratch_depth(0.0, depth_axis), y), 0.0).rgb;
    float3 re = SAMPLE2D(table, float2(d, y), 0.0).rgb;
    float3 im = SAMPLE2D(table, float2(d + 0.5, y), 0.0).rgb;
    float3 turn = 6.28318530718 * fract(2.0 * depth_um / carrier_um);
    return 2.0 * (level - re * cos(turn) + im * sin(turn));
}

// Radiance over a light's that covers q0 to q1, times 1/rho: for lights from 0.05 in
// |x1 - x0| up, x = u/(|u| + scale). The table is f32.
float3 irido_scratch_wide(TEXTURE2D(table), float2 u_axis, float4 depth_axis, float3 carrier_um,
                          float width_um, float depth_um, float q0, float q1)
{
    float3 high = irido_scratch_of_table(PASS2D(table), u_axis, depth_axis, carrier_um,
                                         width_um * q1, depth_um);
    float3 low = irido_scratch_of_table(PASS2D(table), u_axis, depth_axis, carrier_um,
                                        width_um * q0, depth_um);
    return (q1 < 0.0 ? -high : high) - (q0 < 0.0 ? -low : low);
}

// The same for narrower lights, by a table made with --per-place, which may be f16: two Gauss
// points.
float3 irido_scratch_narrow(TEXTURE2D(table), float2 u_axis, float4 depth_axis, float3 carrier_um,
                            float width_um, float depth_um, float q0, float q1)
{
    float u0 = width_um * q0, u1 = width_um * q1;
    float x0 = u0 / (abs(u0) + u_axis.x), x1 = u1 / (abs(u1) + u_axis.x);
    float middle = 0.5 * (x0 + x1), reach = 0.288675135 * (x1 - x0);
    float a = middle - reach, b = middle + reach;
    float3 low = irido_scratch_of_table(PASS2D(table), u_axis, depth_axis, carrier_um,
                                        u_axis.x * abs(a) / (1.0 - abs(a)), depth_um);
    float3 high = irido_scratch_of_table(PASS2D(table), u_axis, depth_axis, carrier_um,
                                         u_axis.x * abs(b) / (1.0 - abs(b)), depth_um);
    return 0.5 * (x1 - x0) * (low + high);
}

// G by the table of irido lut scratch-footprint: distance of the scratch from the footprint's
// centre and half extent of the footprint across it, um.
float irido_scratch_footprint(TEXTURE2D(table), float2 counts, float distance_um, float half_um,
                              float sigma_um)
{
    float y = abs(distance_um) / (half_um + 3.0 * sigma_um), x = half_um / (half_um + sigma_um);
    if (y > 1.0)
        return 0.0;
    float2 place = (float2(0.5, 0.5) + (counts.yx - float2(1.0, 1.0)) * float2(x, y)) / counts.yx;
    return SAMPLE2D(table, place, 0.0).r / (1.0 + half_um / sigma_um);
}
