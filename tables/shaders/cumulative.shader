//! use: common
// XYZ of a perfect reflector of all light up to a wavelength (nm); white Y = 1.
float3 irido_cumulative(TEXTURE2D(table), float3 wavelength_axis, float wavelength_nm)
{
    float u = irido_texel(wavelength_nm, wavelength_axis);
    return SAMPLE2D(table, float2(u, 0.5), 0.0).rgb;
}

// XYZ of a perfect reflector between two wavelengths.
float3 irido_box(TEXTURE2D(table), float3 wavelength_axis, float short_nm, float long_nm)
{
    return irido_cumulative(PASS2D(table), wavelength_axis, long_nm) -
           irido_cumulative(PASS2D(table), wavelength_axis, short_nm);
}
