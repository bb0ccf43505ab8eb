//! use: common
// F_alpha per radian from a table of one alpha; both angles in degrees.
float irido_falpha(TEXTURE2D(table), float3 theta_i_axis, float3 theta_d_axis, float theta_i_deg,
                   float theta_d_deg)
{
    float2 uv = float2(irido_texel(theta_d_deg, theta_d_axis),
                       irido_texel(theta_i_deg, theta_i_axis));
    return SAMPLE2D(table, uv, 0.0).r;
}

// The same from a table of several equally spaced alphas, which are its depth.
float irido_falpha_volume(TEXTURE3D(table), float3 alpha_axis, float3 theta_i_axis,
                          float3 theta_d_axis, float alpha, float theta_i_deg, float theta_d_deg)
{
    float3 uvw = float3(irido_texel(theta_d_deg, theta_d_axis),
                        irido_texel(theta_i_deg, theta_i_axis), irido_texel(alpha, alpha_axis));
    return SAMPLE3D(table, uvw, 0.0).r;
}
