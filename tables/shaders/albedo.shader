//! use: common
// Directional albedo of a rough stack: linear RGB, or XYZ, as the table's metadata says.
float3 irido_albedo(TEXTURE2D(table), float3 cos_axis, float3 alpha_axis, float cos_theta,
                    float alpha)
{
    float2 uv = float2(irido_texel(alpha, alpha_axis), irido_texel(cos_theta, cos_axis));
    return SAMPLE2D(table, uv, 0.0).rgb;
}
