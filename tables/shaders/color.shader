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

// The same of a table over two values that vary: the second is x, the first y, the angle z.
float3 irido_color_of_two(TEXTURE3D(table), float3 angle_axis, float3 first_axis,
                          float3 second_axis, float angle, float first, float second)
{
    float3 uvw = float3(irido_texel(second, second_axis), irido_texel(first, first_axis),
                        irido_texel(angle, angle_axis));
    return SAMPLE3D(table, uvw, 0.0).rgb;
}

float3 irido_color_level(TEXTURE2D(table), float3 angle_axis, float3 value_axis, float angle,
                         float value, float level)
{
    float2 uv = float2(irido_texel(value, irido_axis_of_level(value_axis, level)),
                       irido_texel(angle, irido_axis_of_level(angle_axis, level)));
    return SAMPLE2D(table, uv, level).rgb;
}

// The same of a table with several spreads of the thickness (--sigma), which are its mip levels.
// level: 0 is the first spread; in between, two levels are mixed.
float3 irido_color_of_spread(TEXTURE2D(table), float3 angle_axis, float3 value_axis, float angle,
                             float value, float level)
{
    float low = floor(level);
    float3 color = irido_color_level(PASS2D(table), angle_axis, value_axis, angle, value, low);
    if (level > low)
    {
        float3 next = irido_color_level(PASS2D(table), angle_axis, value_axis, angle, value,
                                        low + 1.0);
        color = lerp(color, next, level - low);
    }
    return color;
}
