//! use: common
// Integrated transmissivity f_t cos of a rough layer, from a table of one alpha. theta_i in degrees,
// vacuum wavelength in nm.
float irido_transmissivity(TEXTURE2D(table), float3 theta_axis, float3 wavelength_axis,
                           float theta_i_deg, float wavelength_nm)
{
    float2 uv = float2(irido_texel(wavelength_nm, wavelength_axis),
                       irido_texel(theta_i_deg, theta_axis));
    return SAMPLE2D(table, uv, 0.0).r;
}

// The same from a table of several equally spaced alphas, which are its depth.
float irido_transmissivity_volume(TEXTURE3D(table), float3 alpha_axis, float3 theta_axis,
                                  float3 wavelength_axis, float alpha, float theta_i_deg,
                                  float wavelength_nm)
{
    float3 uvw = float3(irido_texel(wavelength_nm, wavelength_axis),
                        irido_texel(theta_i_deg, theta_axis), irido_texel(alpha, alpha_axis));
    return SAMPLE3D(table, uvw, 0.0).r;
}
