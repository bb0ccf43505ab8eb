//! use: common
// Colour of a film: linear RGB, or XYZ, as the table's metadata says.
// angle: cos(theta) or theta in degrees, as the table's angle axis; value: what varies.
float3 irido_color(TEXTURE2D(table), float3 angle_axis, float3 value_axis, float angle,
                   float value)
{
    float2 uv = float2(irido_texel(value, value_axis), irido_texel(angle, angle_axis));
    return SAMPLE2D(table, uv, 0.0).rgb;
}

// The same of a table over the angle alone.
float3 irido_color_of_angle(TEXTURE2D(table), float3 angle_axis, float angle)
{
    return SAMPLE2D(table, float2(irido_texel(angle, angle_axis), 0.5), 0.0).rgb;
}
