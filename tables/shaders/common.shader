// Texture coordinate of x along one axis of a table. axis: its first and last value and its number
// of samples, as the table's metadata gives them. Samples lie at the centres of texels.
float irido_texel(float x, float3 axis)
{
    float t = 0.0;
    if (axis.z > 1.0) { t = clamp((x - axis.x) / (axis.y - axis.x), 0.0, 1.0); }
    return (0.5 + (axis.z - 1.0) * t) / axis.z;
}

// The same axis in a mip level, which has half as many samples between the same ends.
float3 irido_axis_of_level(float3 axis, float level)
{
    return float3(axis.xy, max(1.0, floor(axis.z / exp2(level) + 0.001)));
}
