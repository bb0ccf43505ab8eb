//! use: common
// BRDF of a rough layered surface (irido lut brdf), per steradian: linear RGB, or XYZ, as the table's
// metadata says. A coating's mirror is not in it.
//   phi_d_axis, theta_d_axis  axes of the table: first, last, count
//   theta_h_axis              (scale, count): the metadata's request.theta_h_scale_deg, 0 for an axis
//                             that is equally spaced, and its number of samples, from 0 to 90 degrees
//   i, o                      directions away from the surface, above it, its normal along z

float irido_half_angle_place(float2 theta_h_axis, float3 sum)
{
    float theta = 57.29577951308232 * atan2(length(sum.xy), sum.z);
    float place = theta / 90.0;
    if (theta_h_axis.x > 0.0) { place *= (90.0 + theta_h_axis.x) / (theta + theta_h_axis.x); }
    return (0.5 + (theta_h_axis.y - 1.0) * clamp(place, 0.0, 1.0)) / theta_h_axis.y;
}

float irido_difference_angle_place(float3 theta_d_axis, float3 i, float3 o)
{
    float3 sum = i + o, difference = i - o;
    return irido_texel(57.29577951308232 * atan2(length(difference), length(sum)), theta_d_axis);
}

float3 irido_brdf(TEXTURE3D(table), float3 phi_d_axis, float2 theta_h_axis, float3 theta_d_axis,
                  float3 i, float3 o)
{
    float3 sum = i + o, difference = i - o;
    // across the plane of the normal and the half vector, and in it
    float across = (sum.x * difference.y - sum.y * difference.x) * length(sum);
    float along = (sum.x * difference.x + sum.y * difference.y) * sum.z -
                  dot(sum.xy, sum.xy) * difference.z;
    float phi_d = 0.0;
    if (abs(across) + abs(along) > 0.0)
    {
        phi_d = 57.29577951308232 * atan2(abs(across), abs(along));
    }
    float3 place = float3(irido_difference_angle_place(theta_d_axis, i, o),
                          irido_half_angle_place(theta_h_axis, sum),
                          irido_texel(phi_d, phi_d_axis));
    return SAMPLE3D(table, place, 0.0).rgb;
}

// The same of a table with one phi_d.
float3 irido_brdf_slice(TEXTURE2D(table), float2 theta_h_axis, float3 theta_d_axis, float3 i,
                        float3 o)
{
    float2 place = float2(irido_difference_angle_place(theta_d_axis, i, o),
                          irido_half_angle_place(theta_h_axis, i + o));
    return SAMPLE2D(table, place, 0.0).rgb;
}
