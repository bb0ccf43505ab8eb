//! use: common
// Integrated transmissivity f_t cos of a rough layer. theta_i in degrees, vacuum wavelength in nm.
float irido_transmissivity(TEXTURE2D(table), float3 theta_axis, float3 wavelength_axis,
                           float theta_i_deg, float wavelength_nm)
{
    float2 uv = float2(irido_texel(wavelength_nm, wavelength_axis),
                       irido_texel(theta_i_deg, theta_axis));
    return SAMPLE2D(table, uv, 0.0).r;
}
