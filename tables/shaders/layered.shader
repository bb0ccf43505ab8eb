//! use: common
// BRDF of a rough layered surface (irido lut layered), per steradian, linear RGB; a coating's mirror
// is not in it. Define IRIDO_LAYERS, the number of rough layers, before this
// code (in WGSL: const IRIDO_LAYERS = 2;).
//   row_axis, theta_axis  axes of the table: first, last, count
//   groups                of three nodes, as the table's metadata says
//   alpha                 roughness of each layer, the top one first
//   n_outside, n_inside   indices outside and around the layers
//   i, o                  directions away from the surface, its normal along z
#ifndef IRIDO_LAYERS
#define IRIDO_LAYERS 1
#endif

float irido_visibility(float alpha, float cosine)
{
    return 2.0 / (cosine + sqrt(alpha * alpha * (1.0 - cosine * cosine) + cosine * cosine));
}

// Power that a smooth face lets through, unpolarized, from outside at this cosine.
float irido_coating(float n_outside, float n_inside, float cosine)
{
    float eta = n_outside / n_inside;
    float sine = eta * sqrt(max(0.0, 1.0 - cosine * cosine));
    if (n_outside == n_inside) { return 1.0; }
    if (sine >= 1.0) { return 0.0; }
    float inside = sqrt(1.0 - sine * sine);
    float s = (n_outside * cosine - n_inside * inside) / (n_outside * cosine + n_inside * inside);
    float p = (n_inside * cosine - n_outside * inside) / (n_inside * cosine + n_outside * inside);
    return 1.0 - 0.5 * (s * s + p * p);
}

float3 irido_refracted(float eta, float3 direction)
{
    float2 across = eta * direction.xy;
    return float3(across, sqrt(max(0.0, 1.0 - dot(across, across))));
}

float irido_degrees(float cosine)
{
    return 57.29577951308232 * acos(clamp(cosine, 0.0, 1.0));
}

float3 irido_layered(TEXTURE2D(table), float3 row_axis, float3 theta_axis, int groups,
                     FLOATS(alpha, IRIDO_LAYERS), float n_outside, float n_inside, float3 i,
                     float3 o)
{
    float eta = n_outside / n_inside;
    float3 inward = irido_refracted(eta, i);
    float3 outward = irido_refracted(eta, o);
    float3 across = inward + outward;
    float length2 = dot(across, across);
    float tilt_cos2 = across.z * across.z / length2;
    float tilt_sin2 = dot(across.xy, across.xy) / length2;
    float x_d = irido_texel(irido_degrees(0.5 * sqrt(length2)), theta_axis);
    float x_i = irido_texel(irido_degrees(inward.z), theta_axis);
    float x_o = irido_texel(irido_degrees(outward.z), theta_axis);
    // of each layer: masking over the cosines, and the lobe of a mirror's facets
    float seen[IRIDO_LAYERS];
    float lobe[IRIDO_LAYERS];
    for (int layer = 0; layer < IRIDO_LAYERS; layer++)
    {
        float a2 = alpha[layer] * alpha[layer];
        float spread = a2 * tilt_cos2 + tilt_sin2;
        seen[layer] = irido_visibility(alpha[layer], inward.z) *
                      irido_visibility(alpha[layer], outward.z);
        lobe[layer] = 0.25 * a2 / (3.14159265358979 * spread * spread) * seen[layer];
    }
    float3 color = lobe[0] * SAMPLE2D(table, float2(x_d, irido_texel(0.0, row_axis)), 0.0).rgb;
    float row = 1.0;
    int crossed = int(row_axis.z) / (4 * max(groups, 1));  // layers that something is seen through
    for (int group = 0; group < groups; group++)
    {
        float3 through = float3(1.0, 1.0, 1.0);  // of all layers so far, at three nodes
        for (int layer = 0; layer < crossed; layer++)
        {
            float y = irido_texel(row, row_axis);
            through *= seen[layer] * inward.z * outward.z *
                       SAMPLE2D(table, float2(x_i, y), 0.0).rgb *
                       SAMPLE2D(table, float2(x_o, y), 0.0).rgb;
            float3 below =
                through.x * SAMPLE2D(table, float2(x_d, irido_texel(row + 1.0, row_axis)), 0.0).rgb +
                through.y * SAMPLE2D(table, float2(x_d, irido_texel(row + 2.0, row_axis)), 0.0).rgb +
                through.z * SAMPLE2D(table, float2(x_d, irido_texel(row + 3.0, row_axis)), 0.0).rgb;
            float part = 0.318309886183791;  // of a Lambertian base
            if (layer + 1 < IRIDO_LAYERS) { part = lobe[layer + 1]; }
            color += part * below;
            row += 4.0;
        }
    }
    return color * irido_coating(n_outside, n_inside, i.z) *
           irido_coating(n_outside, n_inside, o.z) * eta * eta;
}
